#include "engine/grid/boundary.h"

#include "engine/grid/seed_fill.h"

namespace lamina::engine {

void identify_boundary(LayerGrid& grid) {
  seed_fill(grid, {0, 0}, CellState::kBoundary);
}

}  // namespace lamina::engine
