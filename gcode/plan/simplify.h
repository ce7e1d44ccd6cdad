#pragma once

#include "engine/geometry/polygon.h"

namespace lamina::gcode {

/// The chain without the vertices it does not need: every vertex left out lies within `tolerance` mm of the
/// result (Douglas and Peucker, Algorithms for the reduction of the number of points, 1973). Both ends stay.
engine::Polyline simplified(const engine::Polyline& line, double tolerance);

/// The same for a closed loop. Its first vertex and the one farthest from it stay; a loop that would be left
/// with fewer than three vertices is returned as it was.
engine::Loop simplified_loop(const engine::Loop& loop, double tolerance);

}  // namespace lamina::gcode
