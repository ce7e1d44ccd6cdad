#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/geometry/polygon.h"

namespace lamina::gcode {

/// The pairs (i, j), i < j, of loops whose sides cross properly, each once, in ascending order. Loops that
/// only touch do not cross. A sweep over the sides by ascending y that looks at the sides still open at that
/// height (de Berg et al., Computational Geometry, section 2.1): about n k steps for n sides of which k share
/// a height.
std::vector<std::pair<std::size_t, std::size_t>> crossing_loops(const std::vector<engine::Loop>& loops);

}  // namespace lamina::gcode
