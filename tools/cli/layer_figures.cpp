#include "tools/cli/layer_figures.h"

#include "engine/geometry/polygon.h"
#include "gcode/region/layer_region.h"

namespace lamina::tools {

LayerFigures measure(const engine::Layer& layer, double tolerance) {
  LayerFigures figures;
  figures.index = layer.index;
  figures.z = layer.plane.z;
  gcode::RegionOptions region;
  region.tolerance = tolerance;
  figures.area = engine::area(gcode::make_region(layer, region).region);
  const auto add_length = [&](const engine::PieceCurve& curve) { figures.length += engine::length(curve); };
  for (const engine::ClosedContour& contour : layer.closed) {
    add_length(contour.curve);
    ++figures.closed;
    figures.touch += contour.touch ? 1 : 0;
  }
  for (const engine::OpenContour& contour : layer.open) {
    add_length(contour.curve);
    ++figures.open;
    figures.touch += contour.touch ? 1 : 0;
  }
  for (const engine::PlanarContour& contour : layer.planar) {
    add_length(contour.outer);
    ++figures.planar_outer;
    for (const engine::PieceCurve& inner : contour.inner) add_length(inner);
    figures.planar_inner += contour.inner.size();
  }
  figures.points = layer.points.size();
  return figures;
}

}  // namespace lamina::tools
