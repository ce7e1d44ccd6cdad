#include "engine/import/trim/loop_polygon.h"

namespace lamina::engine {

Loop loop_polygon(const std::vector<NurbsCurve>& curves, int per_span) {
  Loop polygon;
  for (const NurbsCurve& curve : curves) {
    if (curve.degree == 1) {
      for (std::size_t i = 0; i + 1 < curve.control_points.size(); ++i)
        polygon.emplace_back(cartesian(curve.control_points[i]).head<2>());
      continue;
    }
    const std::vector<double> breaks = break_points(curve.knots, curve.degree);
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      for (int k = 0; k < per_span; ++k)
        polygon.emplace_back(
            evaluate(curve, breaks[i] + (breaks[i + 1] - breaks[i]) * k / per_span).head<2>());
    }
  }
  return polygon;
}

bool is_inside(const Loop& polygon, const Vector2& point) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vector2& a = polygon[i];
    const Vector2& b = polygon[j];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

}  // namespace lamina::engine
