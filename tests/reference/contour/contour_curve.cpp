#include "tests/reference/contour/contour_curve.h"

namespace lamina::reference {

engine::Loop flatten_closed(const engine::PlanarCurve& curve, double tolerance) {
  engine::Loop loop = engine::flatten(curve, tolerance);
  if (loop.size() > 1) loop.pop_back();
  return loop;
}

engine::PlanarCurve polyline_curve(const engine::Polyline& points) {
  engine::PlanarCurve curve;
  curve.degree = 1;
  curve.control_points = points;
  const double total = engine::length(points);
  curve.knots = {0.0, 0.0};
  double walked = 0.0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    walked += (points[i] - points[i - 1]).norm();
    curve.knots.push_back(walked / total);
  }
  curve.knots.insert(curve.knots.end(), {1.0, 1.0});
  return curve;
}

}  // namespace lamina::reference
