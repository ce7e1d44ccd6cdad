#include "tools/cli/contours_csv.h"

#include <fmt/format.h>

#include "gcode/marlin/number_text.h"

namespace lamina::tools {
namespace {

constexpr int kDecimals = 6;

}  // namespace

/// Points along the curve; a closed one ends with the point that it began with.
engine::Polyline ContoursCsv::points_of(const engine::PieceCurve& curve) const {
  engine::Polyline points = engine::sample_evenly(curve, step_);
  if (curve.closed && !points.empty()) points.push_back(points.front());
  return points;
}

std::string ContoursCsv::rows(const engine::Layer& layer) {
  std::string text;
  for (const engine::ClosedContour& contour : layer.closed) {
    append(points_of(contour.curve), layer, "closed", text);
  }
  for (const engine::OpenContour& contour : layer.open) {
    append(points_of(contour.curve), layer, "open", text);
  }
  for (const engine::PlanarContour& contour : layer.planar) {
    append(points_of(contour.outer), layer, "planar-outer", text);
    for (const engine::PieceCurve& inner : contour.inner) {
      append(points_of(inner), layer, "planar-inner", text);
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
