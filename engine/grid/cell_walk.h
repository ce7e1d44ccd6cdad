#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "engine/geometry/vector.h"
#include "engine/grid/tile_grid.h"

namespace lamina::engine {

/// The cell of side `epsilon` that a point falls into. The grid is moved by an odd part of a cell so that
/// walls at round coordinates do not run along its lines.
inline TileCell cell_at(const Vector2& point, double epsilon) {
  return {static_cast<std::int64_t>(std::floor(point.x() / epsilon + 0.3819660112501051)),
          static_cast<std::int64_t>(std::floor(point.y() / epsilon + 0.4142135623730951))};
}

/// Visits every cell that a segment passes through, in order (Amanatides and Woo, A fast voxel traversal
/// algorithm for ray tracing, 1987). Where it passes a cell's corner both cells beside the corner are
/// visited.
template <typename Visit>
void walk_cells(const Vector2& from, const Vector2& to, double epsilon, Visit visit) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  constexpr double kCorner = 1e-9;
  TileCell cell = cell_at(from, epsilon);
  const TileCell last = cell_at(to, epsilon);
  visit(cell);
  if (cell == last) return;
  const Vector2 start(from.x() / epsilon + 0.3819660112501051, from.y() / epsilon + 0.4142135623730951);
  const Vector2 step = (to - from) / epsilon;
  const std::int64_t sign_x = step.x() > 0.0 ? 1 : -1;
  const std::int64_t sign_y = step.y() > 0.0 ? 1 : -1;
  const double delta_x = step.x() != 0.0 ? std::abs(1.0 / step.x()) : kNever;
  const double delta_y = step.y() != 0.0 ? std::abs(1.0 / step.y()) : kNever;
  const auto ahead = [](double place, std::int64_t at, std::int64_t sign) {
    return sign > 0 ? static_cast<double>(at + 1) - place : place - static_cast<double>(at);
  };
  double next_x = delta_x == kNever ? kNever : ahead(start.x(), cell.x, sign_x) * delta_x;
  double next_y = delta_y == kNever ? kNever : ahead(start.y(), cell.y, sign_y) * delta_y;
  std::int64_t left = std::abs(last.x - cell.x) + std::abs(last.y - cell.y);
  while (left-- > 0) {
    // The ends decide where the walk stops, whatever rounding says.
    const bool by_x = cell.y == last.y || (cell.x != last.x && next_x <= next_y);
    if (std::abs(next_x - next_y) < kCorner && cell.x != last.x && cell.y != last.y) {
      visit(by_x ? TileCell{cell.x, cell.y + sign_y} : TileCell{cell.x + sign_x, cell.y});
    }
    if (by_x) {
      cell.x += sign_x;
      next_x += delta_x;
    } else {
      cell.y += sign_y;
      next_y += delta_y;
    }
    visit(cell);
  }
}

}  // namespace lamina::engine
