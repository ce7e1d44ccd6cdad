#include "tools/bench/layer_bytes.h"

#include <cstring>

namespace lamina::tools {
namespace {

class Bytes {
 public:
  void number(double value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    text_.append(raw, sizeof value);
  }
  void count(std::size_t value) { number(static_cast<double>(value)); }
  void place(const engine::Vector2& value) {
    number(value.x());
    number(value.y());
  }
  void piece(const engine::LineSegment& line) {
    place(line.start);
    place(line.end);
  }
  void piece(const engine::CircularArc& arc) {
    place(arc.start);
    place(arc.end);
    place(arc.centre);
    number(arc.sweep);
  }
  void piece(const engine::PlanarCurve& spline) {
    count(static_cast<std::size_t>(spline.degree));
    for (const double knot : spline.knots) number(knot);
    for (const engine::Vector2& point : spline.control_points) place(point);
  }
  void curve(const engine::PieceCurve& curve) {
    count(curve.closed ? 1 : 0);
    count(curve.pieces.size());
    for (const engine::CurvePiece& part : curve.pieces) {
      count(part.index());
      std::visit([this](const auto& shape) { piece(shape); }, part);
    }
  }
  void gaps(const std::vector<engine::BridgedGap>& gaps) {
    count(gaps.size());
    for (const engine::BridgedGap& gap : gaps) {
      place(gap.from);
      place(gap.to);
    }
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

}  // namespace

std::string bytes_of(const engine::Layer& layer) {
  Bytes bytes;
  bytes.count(layer.index);
  bytes.number(layer.plane.z);
  bytes.number(layer.plane.bottom);
  bytes.number(layer.plane.top);
  for (const engine::ClosedContour& contour : layer.closed) {
    bytes.count(contour.touch ? 1 : 0);
    bytes.curve(contour.curve);
  }
  for (const engine::OpenContour& contour : layer.open) {
    bytes.count(contour.touch ? 1 : 0);
    bytes.curve(contour.curve);
  }
  for (const engine::PlanarContour& contour : layer.planar) {
    bytes.curve(contour.outer);
    for (const engine::PieceCurve& inner : contour.inner) bytes.curve(inner);
  }
  for (const engine::TouchPoint& point : layer.points) bytes.place(point.position);
  const engine::LayerReport& report = layer.report;
  for (const std::size_t value :
       {report.active_patches, report.patches_added, report.patches_removed, report.cells,
        report.unresolved_cells, report.arcs, report.nodes, report.branchings, report.tiles,
        report.shared_cells, report.close_places, report.meetings, report.resolved_contours,
        report.components, report.control_points, report.dropped_pieces, report.contained_touches}) {
    bytes.count(value);
  }
  bytes.number(report.greatest_fit_distance);
  bytes.number(report.dropped_length);
  bytes.gaps(report.bridged_gaps);
  bytes.gaps(report.open_gaps);
  return bytes.take();
}

}  // namespace lamina::tools
