#pragma once

#include <vector>

#include "engine/geometry/polygon.h"

namespace lamina::gcode {

/// A family of parallel lines: at the heights (k + 1/2) spacing + phase in a frame turned by `angle`.
struct RasterLines {
  double angle = 0.0;    ///< Radians from the x axis.
  double spacing = 1.0;  ///< mm, positive
  double phase = 0.0;    ///< mm
};

/// The lines' parts inside the polygon, joined into chains: where two ends of neighbouring lines follow each
/// other on the polygon's boundary and the way along it is at most `max_link` mm, that way joins them. Every
/// point of a chain lies in the polygon or on its boundary. Chains come by ascending height of their first
/// line.
std::vector<engine::Polyline> raster(const engine::Polygon& polygon, const RasterLines& lines,
                                     double max_link);

}  // namespace lamina::gcode
