#include "engine/grid/point_index.h"

#include <algorithm>
#include <cmath>

namespace lamina::engine {

void PointIndex::clear() {
  points_.clear();
  next_.clear();
  std::fill(table_.begin(), table_.end(), kNone);
}

std::int64_t PointIndex::cell_of(double coordinate) const {
  return static_cast<std::int64_t>(std::floor(coordinate / cell_));
}

std::size_t PointIndex::slot(std::int64_t x, std::int64_t y) const {
  const std::size_t mask = table_.size() - 1;
  auto hash = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15ULL ^
              static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fULL;
  hash ^= hash >> 29;
  std::size_t k = hash & mask;
  while (table_[k] != kNone) {
    const Vector2& there = points_[table_[k]];
    if (cell_of(there.x()) == x && cell_of(there.y()) == y) break;
    k = (k + 1) & mask;
  }
  return k;
}

std::uint32_t PointIndex::first_in(std::int64_t x, std::int64_t y) const {
  return table_[slot(x, y)];
}

std::uint32_t PointIndex::insert(const Vector2& point) {
  if (2 * (points_.size() + 1) > table_.size()) grow();
  const auto number = static_cast<std::uint32_t>(points_.size());
  const std::size_t k = slot(cell_of(point.x()), cell_of(point.y()));
  points_.push_back(point);
  next_.push_back(table_[k]);
  table_[k] = number;
  return number;
}

std::uint32_t PointIndex::find(const Vector2& place, double distance) const {
  std::uint32_t found = kNone;
  const double limit = distance * distance;
  for_each_near(place, [&](std::uint32_t k) {
    if (k < found && (points_[k] - place).squaredNorm() <= limit) found = k;
  });
  return found;
}

void PointIndex::grow() {
  table_.assign(2 * table_.size(), kNone);
  const std::vector<Vector2> points = std::move(points_);
  points_.clear();
  next_.clear();
  for (const Vector2& point : points) {
    const std::size_t k = slot(cell_of(point.x()), cell_of(point.y()));
    const auto number = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
    next_.push_back(table_[k]);
    table_[k] = number;
  }
}

}  // namespace lamina::engine
