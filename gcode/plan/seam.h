#pragma once

#include <cstddef>
#include <vector>

#include "engine/geometry/polygon.h"
#include "gcode/plan/plan_options.h"

namespace lamina::gcode {

/// The vertex at which a closed wall starts. `nozzle` is where the nozzle stands, `below` the seams of the
/// layer below. kAligned takes the vertex nearest to one of those if it is within 3 mm; without one it takes
/// the sharpest corner that turns by more than 30 degrees, and without a corner the rear.
std::size_t seam_vertex(const engine::Loop& loop, SeamPosition position, const engine::Vector2& nozzle,
                        const std::vector<engine::Vector2>& below);

}  // namespace lamina::gcode
