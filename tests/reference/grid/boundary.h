#pragma once

#include "tests/reference/grid/layer_grid.h"

namespace lamina::reference {

using namespace engine;

/// Marks the boundary cells of a component's grid: fills the outside from the lower left cell, which must be
/// empty, and turns each strong cell that borders it by a side into a boundary cell (dissertation p. 146).
void identify_boundary(LayerGrid& grid);

}  // namespace lamina::reference
