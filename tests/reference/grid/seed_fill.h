#pragma once

#include "tests/reference/grid/layer_grid.h"

namespace lamina::reference {

using namespace engine;

/// What a fill ran into.
struct SeedFill {
  std::size_t filled = 0;         ///< cells that became exterior
  bool reached_boundary = false;  ///< it met a cell that was a boundary cell before
};

/// Turns the empty cells connected with `seed` by their sides into exterior ones, and every strong cell that
/// borders them by a side into `rim`. Rows are filled span by span (scanline seed fill; Smith, Tint Fill,
/// SIGGRAPH 1979; dissertation p. 146).
SeedFill seed_fill(LayerGrid& grid, Cell seed, CellState rim);

}  // namespace lamina::reference
