#include "engine/nurbs/ruled.h"

#include <algorithm>
#include <cmath>

#include "engine/nurbs/bezier_chain.h"
#include "engine/nurbs/degree_elevation.h"

namespace lamina::engine {
namespace {

/// Knots closer than this, on [0, 1], are one: they differ by rounding only.
constexpr double kSameKnot = 1e-11;

NurbsCurve on_unit_interval(const NurbsCurve& curve) {
  NurbsCurve result = curve;
  const double first = curve.first_parameter();
  const double length = curve.last_parameter() - first;
  for (double& knot : result.knots) knot = (knot - first) / length;
  return result;
}

/// The knots of `curve` moved by at most kSameKnot onto those of `other`.
NurbsCurve snapped(const NurbsCurve& curve, const Knots& other) {
  NurbsCurve result = curve;
  for (double& knot : result.knots) {
    const auto above = std::lower_bound(other.begin(), other.end(), knot - kSameKnot);
    if (above != other.end() && std::abs(*above - knot) <= kSameKnot) knot = *above;
  }
  return result;
}

std::vector<double> common_breaks(const NurbsCurve& first, const NurbsCurve& second) {
  const std::vector<double> a = break_points(first.knots, first.degree);
  const std::vector<double> b = break_points(second.knots, second.degree);
  std::vector<double> breaks;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(breaks));
  return breaks;
}

}  // namespace

NurbsSurface ruled_surface(const NurbsCurve& first, const NurbsCurve& second) {
  NurbsCurve low = on_unit_interval(first);
  NurbsCurve high = snapped(on_unit_interval(second), low.knots);
  if (low.degree != high.degree || low.knots != high.knots) {
    const std::vector<double> breaks = common_breaks(low, high);
    const int degree = std::max(low.degree, high.degree);
    low = to_curve(elevated(bezier_chain(low, breaks), degree));
    high = to_curve(elevated(bezier_chain(high, breaks), degree));
  }
  NurbsSurface surface;
  surface.degree_u = low.degree;
  surface.degree_v = 1;
  surface.knots_u = low.knots;
  surface.knots_v = {0.0, 0.0, 1.0, 1.0};
  surface.net.count_u = low.control_points.size();
  surface.net.count_v = 2;
  surface.net.points.reserve(2 * low.control_points.size());
  for (std::size_t i = 0; i < low.control_points.size(); ++i) {
    surface.net.points.push_back(low.control_points[i]);
    surface.net.points.push_back(high.control_points[i]);
  }
  return surface;
}

}  // namespace lamina::engine
