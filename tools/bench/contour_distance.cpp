#include "tools/bench/contour_distance.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/segment_distance.h"

namespace lamina::tools {
std::vector<const engine::PieceCurve*> curves_of(const engine::Layer& layer) {
  std::vector<const engine::PieceCurve*> curves;
  for (const engine::ClosedContour& contour : layer.closed) curves.push_back(&contour.curve);
  for (const engine::OpenContour& contour : layer.open) curves.push_back(&contour.curve);
  for (const engine::PlanarContour& contour : layer.planar) {
    curves.push_back(&contour.outer);
    for (const engine::PieceCurve& inner : contour.inner) curves.push_back(&inner);
  }
  return curves;
}

ContourDistance::ContourDistance(const engine::Layer& layer, double tolerance) {
  std::vector<engine::Box2> boxes;
  const auto add = [&](const engine::Vector2& from, const engine::Vector2& to) {
    segments_.push_back({from, to});
    engine::Box2 box(from);
    box.extend(to);
    boxes.push_back(box);
  };
  for (const engine::PieceCurve* curve : curves_of(layer)) {
    const engine::Polyline points = engine::flatten(*curve, tolerance);
    for (std::size_t k = 1; k < points.size(); ++k) add(points[k - 1], points[k]);
    if (curve->closed && !points.empty()) add(points.back(), points.front());
  }
  for (const engine::TouchPoint& point : layer.points) add(point.position, point.position);
  bins_ = PlanarBins(std::move(boxes));
  for (const engine::PlanarContour& contour : layer.planar) {
    engine::Polygon face;
    face.outer = engine::flatten(contour.outer, tolerance);
    for (const engine::PieceCurve& inner : contour.inner)
      face.holes.push_back(engine::flatten(inner, tolerance));
    faces_.push_back(std::move(face));
  }
}

double ContourDistance::distance(const engine::Vector2& place, double enough) const {
  return bins_.nearest(place, enough, [&](std::uint32_t item, double) {
    return std::sqrt(engine::squared_distance(place, segments_[item].from, segments_[item].to));
  });
}

bool ContourDistance::in_face(const engine::Vector2& place) const {
  return std::any_of(faces_.begin(), faces_.end(), [&](const engine::Polygon& face) {
    return engine::contains(face.outer, place) &&
           std::none_of(face.holes.begin(), face.holes.end(),
                        [&](const engine::Loop& hole) { return engine::contains(hole, place); });
  });
}

}  // namespace lamina::tools
