#include "tests/reference/grid/separate.h"

#include <algorithm>

namespace lamina::reference {
namespace {

/// Which strong cells are still to be visited.
class History {
 public:
  explicit History(const LayerGrid& grid)
      : columns_(grid.columns()), visited_(static_cast<std::size_t>(grid.columns() * grid.rows()), false) {}

  /// True the first time it is asked about a cell.
  bool visit(Cell cell) {
    const auto index = static_cast<std::size_t>(cell.y * columns_ + cell.x);
    if (visited_[index]) return false;
    visited_[index] = true;
    return true;
  }

 private:
  std::ptrdiff_t columns_;
  std::vector<bool> visited_;
};

Component collect(const LayerGrid& grid, Cell seed, History& history) {
  Component component;
  std::vector<Cell> stack{seed};
  while (!stack.empty()) {
    const Cell cell = stack.back();
    stack.pop_back();
    component.cells.push_back(cell);
    component.crossed = component.crossed || grid.crossed(cell);
    for (const Cell offset : kMooreNeighbours) {
      const Cell neighbour = cell + offset;
      switch (grid.state(neighbour)) {
        case CellState::kStrongPoint:
          if (history.visit(neighbour)) stack.push_back(neighbour);
          break;
        case CellState::kAbovePoint:
          component.touches_above = true;
          break;
        case CellState::kBelowPoint:
          component.touches_below = true;
          break;
        default:
          break;
      }
    }
  }
  return component;
}

}  // namespace

std::vector<Component> separate(const LayerGrid& layer_grid) {
  std::vector<Component> components;
  History history(layer_grid);
  for (std::ptrdiff_t y = 0; y < layer_grid.rows(); ++y) {
    for (std::ptrdiff_t x = 0; x < layer_grid.columns(); ++x) {
      const Cell cell{x, y};
      if (layer_grid.state(cell) != CellState::kStrongPoint || !history.visit(cell)) continue;
      components.push_back(collect(layer_grid, cell, history));
    }
  }
  return components;
}

LayerGrid component_grid(const LayerGrid& layer_grid, const Component& component) {
  Cell low = component.cells.front();
  Cell high = low;
  for (const Cell cell : component.cells) {
    low = {std::min(low.x, cell.x), std::min(low.y, cell.y)};
    high = {std::max(high.x, cell.x), std::max(high.y, cell.y)};
  }
  const Cell corner{low.x - kComponentMargin, low.y - kComponentMargin};
  LayerGrid grid(layer_grid.location(corner), layer_grid.epsilon(), high.x - low.x + 1 + 2 * kComponentMargin,
                 high.y - low.y + 1 + 2 * kComponentMargin);
  for (const Cell cell : component.cells) {
    const Cell moved{cell.x - corner.x, cell.y - corner.y};
    grid.set(moved, CellState::kStrongPoint);
    if (layer_grid.in_plane(cell)) grid.set_in_plane(moved);
  }
  return grid;
}

}  // namespace lamina::reference
