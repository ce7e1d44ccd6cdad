#include "engine/nurbs/arc.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace lamina::engine {

std::vector<double> arc_breaks(double first, double last) {
  assert(first < last);
  constexpr double kQuarter = std::numbers::pi / 2.0;
  // A full turn computed in floating point must not become five quarters.
  const auto segments = static_cast<int>(std::max(1.0, std::ceil((last - first) / kQuarter - 1e-9)));
  std::vector<double> breaks;
  breaks.reserve(static_cast<std::size_t>(segments) + 1);
  for (int i = 0; i < segments; ++i) breaks.push_back(first + (last - first) * i / segments);
  breaks.push_back(last);
  return breaks;
}

NurbsCurve ellipse_arc(const Vector3& center, const Vector3& x_axis, const Vector3& y_axis, double first,
                       double last) {
  const std::vector<double> breaks = arc_breaks(first, last);
  const double half_step = 0.5 * (last - first) / static_cast<double>(breaks.size() - 1);
  const double weight = std::cos(half_step);
  const auto offset = [&](double angle) {
    return Vector3(std::cos(angle) * x_axis + std::sin(angle) * y_axis);
  };

  NurbsCurve curve;
  curve.degree = 2;
  curve.knots.assign(3, breaks.front());
  curve.control_points.push_back(homogeneous(center + offset(breaks.front())));
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    // The tangents at both ends of a segment meet on the ray of its middle angle, 1 / cos(half step) farther
    // out.
    const double middle = 0.5 * (breaks[i - 1] + breaks[i]);
    curve.control_points.push_back(homogeneous(center + offset(middle) / weight, weight));
    curve.control_points.push_back(homogeneous(center + offset(breaks[i])));
    curve.knots.insert(curve.knots.end(), 2, breaks[i]);
  }
  curve.knots.push_back(breaks.back());
  return curve;
}

}  // namespace lamina::engine
