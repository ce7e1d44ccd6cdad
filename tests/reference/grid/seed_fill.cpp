#include "tests/reference/grid/seed_fill.h"

#include <vector>

namespace lamina::reference {

SeedFill seed_fill(LayerGrid& grid, Cell seed, CellState rim) {
  SeedFill result;
  const auto meet = [&](Cell cell) {
    const CellState state = grid.state(cell);
    if (state == CellState::kStrongPoint) grid.set(cell, rim);
    if (state == CellState::kBoundary && rim != CellState::kBoundary) result.reached_boundary = true;
  };
  std::vector<Cell> stack{seed};
  while (!stack.empty()) {
    const Cell start = stack.back();
    stack.pop_back();
    if (grid.state(start) != CellState::kEmptyPoint) continue;
    std::ptrdiff_t left = start.x;
    while (grid.state({left - 1, start.y}) == CellState::kEmptyPoint) --left;
    std::ptrdiff_t right = start.x;
    while (grid.state({right + 1, start.y}) == CellState::kEmptyPoint) ++right;
    meet({left - 1, start.y});
    meet({right + 1, start.y});
    for (std::ptrdiff_t x = left; x <= right; ++x) grid.set({x, start.y}, CellState::kExterior);
    result.filled += static_cast<std::size_t>(right - left + 1);
    for (const std::ptrdiff_t y : {start.y - 1, start.y + 1}) {
      for (std::ptrdiff_t x = left; x <= right; ++x) {
        const Cell cell{x, y};
        const bool starts_span = grid.state(cell) == CellState::kEmptyPoint &&
                                 (x == left || grid.state({x - 1, y}) != CellState::kEmptyPoint);
        if (starts_span) stack.push_back(cell);
        meet(cell);
      }
    }
  }
  return result;
}

}  // namespace lamina::reference
