#include "engine/nurbs/bezier_chain.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "engine/geometry/bspline_basis.h"

namespace lamina::engine {
namespace {

/// Control point k of the Bezier segment on [first, last], which lies in one knot span: the blossom at
/// `degree - k` times first and k times last.
Vector4 blossom(const NurbsCurve& curve, std::size_t span, double first, double last, std::size_t k) {
  const auto p = static_cast<std::size_t>(curve.degree);
  const auto begin = curve.control_points.begin() + static_cast<std::ptrdiff_t>(span - p);
  std::array<Vector4, kHighestDegree + 1> d;
  std::copy_n(begin, p + 1, d.begin());
  for (std::size_t level = 1; level <= p; ++level) {
    const double argument = level <= p - k ? first : last;
    for (std::size_t j = p; j >= level; --j) {
      const std::size_t i = span - p + j;
      const double low = curve.knots[i];
      const double ratio = (argument - low) / (curve.knots[i + p - level + 1] - low);
      d[j] = (1.0 - ratio) * d[j - 1] + ratio * d[j];
    }
  }
  return d[p];
}

/// A segment's control points, and where on it a parameter lies.
struct Place {
  const Vector4* points;
  double x;       ///< 0 to 1 on the segment
  double length;  ///< of the segment's parameter interval
};

Place place_of(const BezierChain& chain, double t) {
  const auto upper = std::upper_bound(chain.breaks.begin() + 1, chain.breaks.end() - 1, t);
  const auto segment = static_cast<std::size_t>(upper - chain.breaks.begin()) - 1;
  const double first = chain.breaks[segment];
  const double length = chain.breaks[segment + 1] - first;
  return {&chain.control_points[segment * static_cast<std::size_t>(chain.degree)], (t - first) / length,
          length};
}

/// Sum of Bernstein polynomials times points by nested multiplication (Farin, Curves and Surfaces for CAGD,
/// section 5.1).
template <typename PointAt>
Vector4 blend(std::size_t degree, double x, PointAt point_at) {
  const double y = 1.0 - x;
  double power = 1.0;
  double choose = 1.0;
  Vector4 sum = point_at(0);
  for (std::size_t k = 1; k <= degree; ++k) {
    power *= x;
    choose *= static_cast<double>(degree + 1 - k) / static_cast<double>(k);
    sum = y * sum + choose * power * point_at(k);
  }
  return sum;
}

}  // namespace

BezierChain bezier_chain(const NurbsCurve& curve, const std::vector<double>& breaks) {
  assert(breaks.size() >= 2);
  const auto p = static_cast<std::size_t>(curve.degree);
  BezierChain chain;
  chain.degree = curve.degree;
  chain.breaks = breaks;
  chain.control_points.reserve((breaks.size() - 1) * p + 1);
  for (std::size_t s = 0; s + 1 < breaks.size(); ++s) {
    const std::size_t span = find_span(curve.knots, curve.degree, breaks[s]);
    for (std::size_t k = s == 0 ? 0 : 1; k <= p; ++k) {
      chain.control_points.push_back(blossom(curve, span, breaks[s], breaks[s + 1], k));
    }
  }
  return chain;
}

BezierChain bezier_chain(const NurbsCurve& curve) {
  return bezier_chain(curve, break_points(curve.knots, curve.degree));
}

Vector3 evaluate(const BezierChain& chain, double t) {
  const Place place = place_of(chain, t);
  const auto degree = static_cast<std::size_t>(chain.degree);
  return cartesian(blend(degree, place.x, [&](std::size_t k) { return place.points[k]; }));
}

CurveDerivative evaluate_derivative(const BezierChain& chain, double t) {
  const Place place = place_of(chain, t);
  const auto degree = static_cast<std::size_t>(chain.degree);
  const Vector4 sum = blend(degree, place.x, [&](std::size_t k) { return place.points[k]; });
  const Vector4 change = blend(degree - 1, place.x,
                               [&](std::size_t k) { return Vector4(place.points[k + 1] - place.points[k]); });
  const Vector3 point = cartesian(sum);
  const double factor = chain.degree / (place.length * sum.w());
  return {point, factor * (change.head<3>() - change.w() * point)};
}

NurbsCurve to_curve(const BezierChain& chain) {
  NurbsCurve curve;
  curve.degree = chain.degree;
  curve.control_points = chain.control_points;
  curve.knots.push_back(chain.breaks.front());
  for (const double knot : chain.breaks) {
    curve.knots.insert(curve.knots.end(), static_cast<std::size_t>(chain.degree), knot);
  }
  curve.knots.push_back(chain.breaks.back());
  return curve;
}

}  // namespace lamina::engine
