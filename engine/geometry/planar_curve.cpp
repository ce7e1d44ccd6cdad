#include "engine/geometry/planar_curve.h"

#include <algorithm>
#include <cmath>

namespace lamina::engine {
namespace {

Vector2 combine(const PlanarCurve& curve, std::size_t span, const BasisRow& basis) {
  Vector2 sum = Vector2::Zero();
  const std::size_t first = span - static_cast<std::size_t>(curve.degree);
  for (std::size_t r = 0; r < basis.size(); ++r) sum += basis[r] * curve.control_points[first + r];
  return sum;
}

/// Control points of the derivative curve, which has one degree less and the inner knots of `curve` (The
/// NURBS Book, equation 3.8).
PlanarCurve derivative_curve(const PlanarCurve& curve) {
  const auto p = static_cast<std::size_t>(curve.degree);
  PlanarCurve result;
  result.degree = curve.degree - 1;
  result.knots.assign(curve.knots.begin() + 1, curve.knots.end() - 1);
  result.control_points.reserve(curve.control_points.size() - 1);
  for (std::size_t i = 0; i + 1 < curve.control_points.size(); ++i) {
    const double width = curve.knots[i + p + 1] - curve.knots[i + 1];
    const Vector2 step = curve.control_points[i + 1] - curve.control_points[i];
    result.control_points.push_back(width > 0.0 ? Vector2(static_cast<double>(p) / width * step)
                                                : Vector2::Zero());
  }
  return result;
}

/// The largest length of the control points that matter on `span`: a bound of the curve there.
double bound_on_span(const PlanarCurve& curve, std::size_t span) {
  double bound = 0.0;
  for (std::size_t i = span - static_cast<std::size_t>(curve.degree); i <= span; ++i) {
    bound = std::max(bound, curve.control_points[i].norm());
  }
  return bound;
}

}  // namespace

Vector2 evaluate(const PlanarCurve& curve, double t) {
  const std::size_t span = find_span(curve.knots, curve.degree, t);
  return combine(curve, span, basis_functions(curve.knots, curve.degree, span, t));
}

Vector2 evaluate_derivative(const PlanarCurve& curve, double t) {
  const std::size_t span = find_span(curve.knots, curve.degree, t);
  return combine(curve, span, basis_derivatives(curve.knots, curve.degree, span, t)[1]);
}

Polyline flatten(const PlanarCurve& curve, double tolerance) {
  Polyline points{curve.control_points.front()};
  const bool straight = curve.degree < 2;
  const PlanarCurve second = straight ? PlanarCurve{} : derivative_curve(derivative_curve(curve));
  const auto p = static_cast<std::size_t>(curve.degree);
  for (std::size_t span = p; span + p + 1 < curve.knots.size(); ++span) {
    const double begin = curve.knots[span];
    const double width = curve.knots[span + 1] - begin;
    if (width <= 0.0) continue;
    // Dropping the two outer knots on each side shifts the span's index by two.
    const double curvature = straight ? 0.0 : bound_on_span(second, span - 2);
    const double chords = std::max(1.0, std::ceil(width * std::sqrt(curvature / (8.0 * tolerance))));
    for (double k = 1.0; k < chords; ++k) points.push_back(evaluate(curve, begin + width * (k / chords)));
    points.push_back(combine(curve, span, basis_functions(curve.knots, curve.degree, span, begin + width)));
  }
  return points;
}

Box2 control_box(const PlanarCurve& curve) {
  Box2 box;
  for (const Vector2& point : curve.control_points) box.extend(point);
  return box;
}

}  // namespace lamina::engine
