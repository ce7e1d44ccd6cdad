#include "engine/nurbs/bezier_chain.h"

#include <cassert>

#include "engine/geometry/bspline_basis.h"

namespace lamina::engine {
namespace {

/// Control point k of the Bezier segment on [first, last], which lies in one knot span: the blossom at
/// `degree - k` times first and k times last.
Vector4 blossom(const NurbsCurve& curve, std::size_t span, double first, double last, std::size_t k) {
  const auto p = static_cast<std::size_t>(curve.degree);
  const auto begin = curve.control_points.begin() + static_cast<std::ptrdiff_t>(span - p);
  std::vector<Vector4> d(begin, begin + curve.degree + 1);
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
