#pragma once

#include <array>
#include <cstddef>
#include <type_traits>

#include "engine/geometry/bspline_basis.h"
#include "engine/geometry/planar_curve.h"

namespace lamina::engine {

inline constexpr int kHighestWindowDegree = 5;

/// The degree + 1 basis functions that do not vanish on a knot span, and their first derivatives, in fixed
/// storage: what `basis_functions` and `basis_derivatives` give, for the inner loops of the fit.
struct BasisWindow {
  std::size_t first = 0;  ///< control point of the first one: span - degree
  std::array<double, kHighestWindowDegree + 1> value{};
  std::array<double, kHighestWindowDegree + 1> slope{};
};

/// The window of one knot span: prepared once, evaluated for many parameters without a division.
template <int kDegree>
class SpanBasis {
 public:
  static_assert(kDegree >= 1 && kDegree <= kHighestWindowDegree);

  SpanBasis(const Knots& knots, std::size_t span) : first_(span - kCount) {
    for (std::size_t i = 0; i < 2 * kCount; ++i) knots_[i] = knots[first_ + 1 + i];
    for (std::size_t j = 1; j <= kCount; ++j) {
      for (std::size_t r = 0; r < j; ++r)
        inverse_[j - 1][r] = 1.0 / (knots_[kCount + r] - knots_[kCount + r - j]);
    }
  }

  /// At t, which lies on the span. The NURBS Book, A2.2 and equation 2.7.
  BasisWindow at(double t) const {
    BasisWindow window;
    window.first = first_;
    window.value[0] = 1.0;
    for (std::size_t j = 1; j <= kCount; ++j) {
      double saved = 0.0;
      double saved_slope = 0.0;
      for (std::size_t r = 0; r < j; ++r) {
        const double term = window.value[r] * inverse_[j - 1][r];
        window.value[r] = saved + (knots_[kCount + r] - t) * term;
        saved = (t - knots_[kCount + r - j]) * term;
        if (j == kCount) {
          const double steep = static_cast<double>(kDegree) * term;
          window.slope[r] = saved_slope - steep;
          saved_slope = steep;
        }
      }
      window.value[j] = saved;
      window.slope[j] = saved_slope;
    }
    return window;
  }

 private:
  static constexpr auto kCount = static_cast<std::size_t>(kDegree);

  std::size_t first_;
  std::array<double, 2 * kCount> knots_{};  // those around the span: it begins at index kCount - 1
  std::array<std::array<double, kCount>, kCount> inverse_{};
};

/// Calls `visit` with the degree (1 to kHighestWindowDegree) as a compile-time constant.
template <typename Visit>
decltype(auto) with_degree(int degree, Visit&& visit) {
  switch (degree) {
    case 1:
      return visit(std::integral_constant<int, 1>{});
    case 2:
      return visit(std::integral_constant<int, 2>{});
    case 3:
      return visit(std::integral_constant<int, 3>{});
    case 4:
      return visit(std::integral_constant<int, 4>{});
    default:
      return visit(std::integral_constant<int, 5>{});
  }
}

}  // namespace lamina::engine
