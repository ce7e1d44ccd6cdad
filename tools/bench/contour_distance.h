#pragma once

#include <vector>

#include "engine/layer.h"
#include "tools/bench/planar_bins.h"

namespace lamina::tools {

/// All curves of a layer, the rims of planar contours among them.
std::vector<const engine::PieceCurve*> curves_of(const engine::Layer& layer);

/// Distances from points of the plane to what a layer holds.
class ContourDistance {
 public:
  /// Curves are taken as chains within `tolerance` (mm) of them.
  ContourDistance(const engine::Layer& layer, double tolerance);

  /// To the nearest curve or touch point, mm; infinite for an empty layer. At most `enough`, it is an upper
  /// bound of the true distance.
  double distance(const engine::Vector2& place, double enough) const;

  /// Whether a planar contour covers the place.
  bool in_face(const engine::Vector2& place) const;

 private:
  struct Segment {
    engine::Vector2 from;
    engine::Vector2 to;
  };

  std::vector<Segment> segments_;
  PlanarBins bins_;
  std::vector<engine::Polygon> faces_;
};

}  // namespace lamina::tools
