#include "tests/reference/grid/planar.h"

#include <algorithm>
#include <iterator>

#include "tests/reference/grid/seed_fill.h"

namespace lamina::reference {
namespace {

bool inside_face(const LayerGrid& grid, Cell cell) {
  return grid.in_plane(cell) && std::all_of(std::begin(kMooreNeighbours), std::end(kMooreNeighbours),
                                            [&](Cell offset) { return grid.in_plane(cell + offset); });
}

template <typename Visit>
void for_each_cell(const LayerGrid& grid, Visit visit) {
  for (std::ptrdiff_t y = 0; y < grid.rows(); ++y) {
    for (std::ptrdiff_t x = 0; x < grid.columns(); ++x) visit(Cell{x, y});
  }
}

}  // namespace

PlanarCase identify_planar(LayerGrid& grid) {
  bool holes = false;
  bool only_a_curve = false;
  bool face = false;
  for_each_cell(grid, [&](Cell cell) {
    if (grid.state(cell) == CellState::kStrongPoint) face = face || inside_face(grid, cell);
    if (grid.state(cell) != CellState::kEmptyPoint) return;
    const SeedFill fill = seed_fill(grid, cell, CellState::kInteriorBoundary);
    holes = true;
    only_a_curve = only_a_curve || fill.reached_boundary;
  });
  const bool planar = face && !only_a_curve;
  for_each_cell(grid, [&](Cell cell) {
    const CellState state = grid.state(cell);
    if (state == CellState::kStrongPoint) grid.set(cell, planar ? CellState::kPlanar : CellState::kExterior);
    if (state == CellState::kInteriorBoundary && !planar) grid.set(cell, CellState::kExterior);
  });
  if (!planar) return holes ? PlanarCase::kNone : PlanarCase::kNothingInside;
  return holes ? PlanarCase::kWithHoles : PlanarCase::kWithoutHoles;
}

}  // namespace lamina::reference
