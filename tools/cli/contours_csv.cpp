#include "tools/cli/contours_csv.h"

#include <fmt/format.h>

#include "gcode/marlin/number_text.h"

namespace lamina::tools {
namespace {

constexpr int kDecimals = 6;

}  // namespace

std::string ContoursCsv::rows(const engine::Layer& layer) {
  std::string text;
  for (const engine::ClosedContour& contour : layer.closed) {
    append(engine::sample_evenly(contour.curve, step_), layer, "closed", text);
  }
  for (const engine::OpenContour& contour : layer.open) {
    append(engine::sample_evenly(contour.curve, step_), layer, "open", text);
  }
  for (const engine::PlanarContour& contour : layer.planar) {
    append(engine::sample_evenly(contour.outer, step_), layer, "planar-outer", text);
    for (const engine::PlanarCurve& inner : contour.inner) {
      append(engine::sample_evenly(inner, step_), layer, "planar-inner", text);
    }
  }
  for (const engine::TouchPoint& point : layer.points) append({point.position}, layer, "point", text);
  return text;
}

void ContoursCsv::append(const engine::Polyline& points, const engine::Layer& layer, const char* kind,
                         std::string& text) {
  const std::string rest = fmt::format(",{},{},{},{}\n", gcode::number_text(layer.plane.z, kDecimals),
                                       next_contour_++, layer.index, kind);
  for (const engine::Vector2& point : points) {
    text += gcode::number_text(point.x(), kDecimals);
    text += ',';
    text += gcode::number_text(point.y(), kDecimals);
    text += rest;
  }
}

}  // namespace lamina::tools
