#include "tests/reference/as_engine_layer.h"

namespace lamina::reference {
namespace {

engine::PieceCurve spline(const engine::PlanarCurve& curve, bool closed) {
  return {{curve}, closed};
}

}  // namespace

engine::Layer as_engine_layer(const Layer& layer) {
  engine::Layer result;
  result.index = layer.index;
  result.plane = layer.plane;
  for (const ClosedContour& contour : layer.closed) {
    result.closed.push_back({spline(contour.curve, true), contour.touch});
  }
  for (const OpenContour& contour : layer.open) {
    result.open.push_back({spline(contour.curve, false), contour.touch});
  }
  for (const PlanarContour& contour : layer.planar) {
    engine::PlanarContour planar{spline(contour.outer, true), {}};
    for (const engine::PlanarCurve& inner : contour.inner) planar.inner.push_back(spline(inner, true));
    result.planar.push_back(std::move(planar));
  }
  for (const TouchPoint& point : layer.points) result.points.push_back({point.position});
  return result;
}

}  // namespace lamina::reference
