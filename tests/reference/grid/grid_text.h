#pragma once

#include <string>
#include <vector>

#include "tests/reference/grid/layer_grid.h"

namespace lamina::tests {

/// A grid as text, the highest row first, one character a cell:
///   .  empty       v  below        ^  above              #  strong
///   ,  exterior    o  boundary     i  interior boundary  p  planar      r  repaired exterior
/// Cells are 1 mm wide and the lower left corner is the origin.
using GridText = std::vector<std::string>;

reference::LayerGrid grid_from_text(const GridText& rows);
GridText text_of(const reference::LayerGrid& grid);

}  // namespace lamina::tests
