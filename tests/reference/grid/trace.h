#pragma once

#include <cstddef>
#include <vector>

#include "tests/reference/grid/layer_grid.h"

namespace lamina::reference {

using namespace engine;

/// Cells in walking order, neighbours in the Moore sense. A closed chain's last cell neighbours its first.
struct CellChain {
  std::vector<Cell> cells;
  bool closed = false;
};

struct TraceResult {
  std::vector<CellChain> chains;
  std::size_t dropped_spurs = 0;  ///< cells in dead ends too short to be a chain of their own
};

/// Orders all cells in state `line` by Moore-neighbour tracing: from the first cell, row by row from the
/// lower left, always on to the first unvisited neighbour, clockwise from where the walk came (dissertation
/// p. 149).
///
/// Where the walk ends beside a cell that it passed before, the cells between form a closed chain and the
/// walk goes on from that cell: contours that meet in one cell come apart into closed chains. A walk that
/// ends elsewhere is an open chain; it is walked again from its end, because it may have begun in the middle.
/// A branch that hangs on a closed chain is an open chain of its own from four cells on, else it is dropped
/// and counted.
TraceResult trace(const LayerGrid& grid, CellState line);

}  // namespace lamina::reference
