#pragma once

#include <cstddef>
#include <vector>

namespace lamina::engine {

/// A knot vector: non-decreasing, `control points + degree + 1` long. The curve lives on
/// [knots[degree], knots[size - 1 - degree]].
using Knots = std::vector<double>;

/// Index i with knots[i] <= t < knots[i + 1], clamped to the valid spans, so that t at the upper end of the
/// domain belongs to the last span of positive length. The NURBS Book, A2.1.
std::size_t find_span(const Knots& knots, int degree, double t);

/// The `degree + 1` basis functions that do not vanish on `span`, at t; they sum to one. The first belongs to
/// control point `span - degree`. The NURBS Book, A2.2.
std::vector<double> basis_functions(const Knots& knots, int degree, std::size_t span, double t);

/// Values and derivatives: row k holds the k-th derivatives of the non-vanishing basis functions, k = 0 ...
/// `order`. Rows above the degree are zero. The NURBS Book, A2.3.
std::vector<std::vector<double>> basis_derivatives(const Knots& knots, int degree, std::size_t span, double t,
                                                   int order);

/// Values of the `degree + 1` Bernstein polynomials at t in [0, 1]. The NURBS Book, A1.3.
std::vector<double> bernstein(int degree, double t);

/// The distinct knots of the domain, ascending: the ends of the non-zero knot spans.
std::vector<double> break_points(const Knots& knots, int degree);

}  // namespace lamina::engine
