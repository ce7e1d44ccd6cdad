#include "tests/reference/grid/boundary.h"

#include "tests/reference/grid/seed_fill.h"

namespace lamina::reference {

void identify_boundary(LayerGrid& grid) {
  seed_fill(grid, {0, 0}, CellState::kBoundary);
}

}  // namespace lamina::reference
