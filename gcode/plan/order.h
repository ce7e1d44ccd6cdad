#pragma once

#include <cstddef>
#include <vector>

#include "engine/geometry/vector.h"
#include "gcode/plan/bead_path.h"
#include "gcode/plan/island.h"

namespace lamina::gcode {

/// Distance from a point to where a path can begin, mm: any vertex of a closed one, either end of an open
/// one.
double distance_to_start(const BeadPath& path, const engine::Vector2& point);

/// Position of the path that begins nearest to the point; the first of equals. The list must not be empty.
std::size_t nearest_path(const std::vector<BeadPath>& paths, const engine::Vector2& point);

/// Position of the island whose first group begins nearest to the point. The list must not be empty.
std::size_t nearest_island(const std::vector<Island>& islands, const engine::Vector2& point);

}  // namespace lamina::gcode
