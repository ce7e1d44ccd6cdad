#pragma once

#include <vector>

#include "engine/geometry/vector.h"

namespace lamina::tools {

/// Lower left corners for rectangles of these sizes, mm, at least `spacing` apart and together in the middle
/// of a bed with its corner at the origin: rows from front to back, the deepest first (next-fit decreasing
/// height; Coffman, Garey, Johnson and Tarjan, 1980). In the order of `sizes`. Throws Failure where they do
/// not fit.
std::vector<engine::Vector2> arrange(const std::vector<engine::Vector2>& sizes, double spacing,
                                     const engine::Vector2& bed);

}  // namespace lamina::tools
