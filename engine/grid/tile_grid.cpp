#include "engine/grid/tile_grid.h"

#include <algorithm>
#include <iterator>

namespace lamina::engine {

void TileGrid::clear() {
  used_ = 0;
  recent_ = kNone;
  std::fill(table_.begin(), table_.end(), kNone);
}

bool TileGrid::test(TileCell cell) const {
  const std::uint32_t tile = table_[slot(cell.x >> 6, cell.y >> 6)];
  if (tile == kNone) return false;
  return (tiles_[tile].rows[static_cast<std::size_t>(cell.y & 63)] >> static_cast<unsigned>(cell.x & 63) &
          1U) != 0;
}

std::size_t TileGrid::slot(std::int64_t x, std::int64_t y) const {
  const std::size_t mask = table_.size() - 1;
  auto hash = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15ULL ^
              static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fULL;
  hash ^= hash >> 29;
  std::size_t k = hash & mask;
  while (table_[k] != kNone && (tiles_[table_[k]].x != x || tiles_[table_[k]].y != y)) k = (k + 1) & mask;
  return k;
}

TileGrid::Tile& TileGrid::find_or_add(std::int64_t x, std::int64_t y) {
  std::size_t k = slot(x, y);
  if (table_[k] == kNone) {
    if (2 * (used_ + 1) > table_.size()) {
      table_.assign(2 * table_.size(), kNone);
      for (std::uint32_t t = 0; t < used_; ++t) table_[slot(tiles_[t].x, tiles_[t].y)] = t;
      k = slot(x, y);
    }
    if (used_ == tiles_.size()) tiles_.emplace_back();
    Tile& tile = tiles_[used_];
    tile.x = x;
    tile.y = y;
    std::fill(std::begin(tile.rows), std::end(tile.rows), 0);
    table_[k] = static_cast<std::uint32_t>(used_++);
  }
  recent_ = table_[k];
  return tiles_[recent_];
}

}  // namespace lamina::engine
