#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/geometry/vector.h"

namespace lamina::engine {

/// Points by place: buckets of square cells in an open-addressing table. Numbers are given out in the order
/// of insertion and found in it, so results do not depend on the table.
class PointIndex {
 public:
  /// `reach`: the distance of later searches, mm.
  explicit PointIndex(double reach) : cell_(2.0 * reach) { table_.assign(64, kNone); }

  /// Forgets the points, keeps the memory.
  void clear();

  std::uint32_t insert(const Vector2& point);

  /// The first point within `distance` (at most the reach) of a place, or `kNone`.
  std::uint32_t find(const Vector2& place, double distance) const;

  /// Calls `visit(number)` for all points in the cells that the reach around a place meets.
  template <typename Visit>
  void for_each_near(const Vector2& place, Visit visit) const {
    const double reach = 0.5 * cell_;
    const std::int64_t x0 = cell_of(place.x() - reach);
    const std::int64_t x1 = cell_of(place.x() + reach);
    const std::int64_t y0 = cell_of(place.y() - reach);
    const std::int64_t y1 = cell_of(place.y() + reach);
    for (std::int64_t x = x0; x <= x1; ++x) {
      for (std::int64_t y = y0; y <= y1; ++y) {
        for (std::uint32_t k = first_in(x, y); k != kNone; k = next_[k]) visit(k);
      }
    }
  }

  std::size_t size() const { return points_.size(); }
  const Vector2& point(std::uint32_t number) const { return points_[number]; }

  static constexpr std::uint32_t kNone = 0xffffffff;

 private:
  std::int64_t cell_of(double coordinate) const;
  std::size_t slot(std::int64_t x, std::int64_t y) const;
  std::uint32_t first_in(std::int64_t x, std::int64_t y) const;
  void grow();

  double cell_;
  std::vector<Vector2> points_;
  std::vector<std::uint32_t> next_;  ///< next point in the same cell
  std::vector<std::uint32_t>
      table_;  ///< first point of a cell; its own cell tells whether it is the right one
};

}  // namespace lamina::engine
