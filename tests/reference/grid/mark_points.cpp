#include "tests/reference/grid/mark_points.h"

#include <cmath>

namespace lamina::reference {
namespace {

/// Points this far from the plane, as a part of epsilon, are well above or below it. A steep surface has some
/// on both sides in one cell, because its samples are at most half of epsilon apart; one that only grazes the
/// plane has not.
constexpr double kWellOff = 0.25;

}  // namespace

std::size_t mark_points(LayerGrid& grid, const std::vector<Vector3>& points, double z) {
  std::size_t near_plane = 0;
  for (const Vector3& point : points) {
    const double height = point.z() - z;
    if (std::abs(height) > grid.epsilon()) continue;
    ++near_plane;
    const Cell cell = grid.cell_at(point.head<2>());
    const bool in_plane = std::abs(height) <= kModelTolerance;
    if (in_plane) grid.set_in_plane(cell);
    if (height > kWellOff * grid.epsilon()) grid.set_well_above(cell);
    if (height < -kWellOff * grid.epsilon()) grid.set_well_below(cell);
    const CellState side = height > 0.0 ? CellState::kAbovePoint : CellState::kBelowPoint;
    const CellState known = grid.state(cell);
    if (in_plane || (known != CellState::kEmptyPoint && known != side)) {
      grid.set(cell, CellState::kStrongPoint);
    } else {
      grid.set(cell, side);
    }
  }
  return near_plane;
}

void join_opposite_neighbours(LayerGrid& grid) {
  const auto opposite = [](CellState state) {
    return state == CellState::kAbovePoint ? CellState::kBelowPoint : CellState::kAbovePoint;
  };
  for (std::ptrdiff_t y = 0; y < grid.rows(); ++y) {
    for (std::ptrdiff_t x = 0; x < grid.columns(); ++x) {
      const Cell cell{x, y};
      const CellState state = grid.state(cell);
      if (state != CellState::kAbovePoint && state != CellState::kBelowPoint) continue;
      for (const Cell neighbour : {Cell{x + 1, y}, Cell{x, y + 1}}) {
        if (grid.state(neighbour) != opposite(state)) continue;
        grid.set(cell, CellState::kStrongPoint);
        grid.set(neighbour, CellState::kStrongPoint);
        grid.share_crossing(cell, neighbour);
      }
    }
  }
}

MarkedGrid make_layer_grid(const std::vector<ListedPatch>& global_list, const ActiveList& active, double z,
                           double epsilon) {
  Box2 box;
  for (const ActivePatch& patch : active.patches()) {
    const Box3& around = global_list[patch.index].box;
    box.extend(Vector2(around.min().head<2>()));
    box.extend(Vector2(around.max().head<2>()));
  }
  if (box.isEmpty()) return {LayerGrid(Vector2::Zero(), epsilon, 0, 0), 0};
  MarkedGrid marked{LayerGrid::covering(box, epsilon), 0};
  for (const ActivePatch& patch : active.patches()) {
    marked.points_near_plane += mark_points(marked.grid, patch.points, z);
  }
  join_opposite_neighbours(marked.grid);
  return marked;
}

}  // namespace lamina::reference
