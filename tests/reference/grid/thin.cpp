#include "tests/reference/grid/thin.h"

#include <algorithm>
#include <array>
#include <vector>

namespace lamina::reference {
namespace {

/// Which of the eight neighbours are boundary cells, in the order of kMooreNeighbours.
std::array<bool, 8> boundary_neighbours(const LayerGrid& grid, Cell cell) {
  std::array<bool, 8> neighbours{};
  for (std::size_t k = 0; k < 8; ++k) {
    neighbours[k] = grid.state(cell + kMooreNeighbours[k]) == CellState::kBoundary;
  }
  return neighbours;
}

/// How many pieces the neighbourhood falls into when the cell is gone; one: nothing is torn apart or filled.
int connectivity_number(const std::array<bool, 8>& neighbours) {
  int number = 0;
  for (std::size_t k = 0; k < 8; k += 2) {
    if (!neighbours[k] && (neighbours[k + 1] || neighbours[(k + 2) % 8])) ++number;
  }
  return number;
}

bool is_removable(const LayerGrid& grid, Cell cell) {
  const std::array<bool, 8> neighbours = boundary_neighbours(grid, cell);
  return std::count(neighbours.begin(), neighbours.end(), true) >= 2 && connectivity_number(neighbours) == 1;
}

}  // namespace

std::size_t thin_lines(LayerGrid& grid) {
  std::vector<Cell> line;
  for (std::ptrdiff_t y = 0; y < grid.rows(); ++y) {
    for (std::ptrdiff_t x = 0; x < grid.columns(); ++x) {
      if (grid.state({x, y}) == CellState::kBoundary) line.push_back({x, y});
    }
  }
  const std::size_t before = line.size();
  for (bool changed = true; changed;) {
    changed = false;
    for (const Cell side : kSideNeighbours) {
      // Cells are looked at one side at a time so that a line of two rows loses one of them, not both.
      std::erase_if(line, [&](Cell cell) {
        if (grid.state(cell + side) == CellState::kBoundary || !is_removable(grid, cell)) return false;
        grid.set(cell, CellState::kRepairedExterior);
        changed = true;
        return true;
      });
    }
  }
  return before - line.size();
}

}  // namespace lamina::reference
