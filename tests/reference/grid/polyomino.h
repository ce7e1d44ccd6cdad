#pragma once

#include <cstddef>

#include "tests/reference/grid/layer_grid.h"

namespace lamina::reference {

using namespace engine;

/// Thins a line of cells in state `line` (boundary or interior boundary) by one sweep, row by row: a cell in
/// the middle of one of the twelve polyominoes (four angle trominoes, eight Z and S tetrominoes; dissertation
/// p. 148) becomes repaired exterior, and so does a cell with no neighbour unless it is all there is. The
/// cells that are left stay connected by the Moore neighbourhood. Returns how many were taken out.
std::size_t eliminate_polyominoes(LayerGrid& grid, CellState line);

}  // namespace lamina::reference
