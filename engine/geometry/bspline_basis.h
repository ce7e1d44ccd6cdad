#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <vector>

namespace lamina::engine {

/// A knot vector: non-decreasing, `control points + degree + 1` long. The curve lives on
/// [knots[degree], knots[size - 1 - degree]].
using Knots = std::vector<double>;

/// Index i with knots[i] <= t < knots[i + 1], clamped to the valid spans, so that t at the upper end of the
/// domain belongs to the last span of positive length. The NURBS Book, A2.1.
std::size_t find_span(const Knots& knots, int degree, double t);

/// No curve or surface has a higher degree; what readers accept stays far below.
inline constexpr int kHighestDegree = 63;

/// One value for each basis function that does not vanish on a span, at first undefined, in storage of its
/// own: evaluation takes no memory from the heap.
class BasisRow {
 public:
  explicit BasisRow(int degree) : size_(static_cast<std::size_t>(degree) + 1) {
    assert(0 <= degree && degree <= kHighestDegree);
  }

  std::size_t size() const { return size_; }
  double& operator[](std::size_t i) { return values_[i]; }
  double operator[](std::size_t i) const { return values_[i]; }
  double* begin() { return values_.data(); }
  double* end() { return values_.data() + size_; }
  const double* begin() const { return values_.data(); }
  const double* end() const { return values_.data() + size_; }

 private:
  std::size_t size_;
  std::array<double, kHighestDegree + 1> values_;
};

/// The `degree + 1` basis functions that do not vanish on `span`, at t; they sum to one. The first belongs to
/// control point `span - degree`. The NURBS Book, A2.2.
BasisRow basis_functions(const Knots& knots, int degree, std::size_t span, double t);

/// Values, first and second derivatives of the non-vanishing basis functions. Rows above the degree are zero.
/// The NURBS Book, A2.3.
std::array<BasisRow, 3> basis_derivatives(const Knots& knots, int degree, std::size_t span, double t);

/// Values of the `degree + 1` Bernstein polynomials at t in [0, 1]. The NURBS Book, A1.3.
std::vector<double> bernstein(int degree, double t);

/// The distinct knots of the domain, ascending: the ends of the non-zero knot spans.
std::vector<double> break_points(const Knots& knots, int degree);

}  // namespace lamina::engine
