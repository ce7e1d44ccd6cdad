#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lamina::engine {

/// Place of a cell in an unbounded grid.
struct TileCell {
  std::int64_t x = 0;
  std::int64_t y = 0;
  bool operator==(const TileCell&) const = default;
};

/// The layer grid, sparse: one bit to a cell, in tiles of 64 x 64 cells that exist only where a bit was set.
/// Tiles are recycled from layer to layer (the pool that the dissertation wished for, chapter eight).
class TileGrid {
 public:
  TileGrid() { table_.assign(64, kNone); }

  /// Forgets all bits, keeps the memory.
  void clear();

  /// Sets a cell's bit; true when it was set before.
  bool test_and_set(TileCell cell) {
    Tile& tile = tile_at(cell.x >> 6, cell.y >> 6);
    std::uint64_t& row = tile.rows[static_cast<std::size_t>(cell.y & 63)];
    const std::uint64_t bit = std::uint64_t{1} << static_cast<unsigned>(cell.x & 63);
    const bool before = (row & bit) != 0;
    row |= bit;
    return before;
  }

  bool test(TileCell cell) const;

  std::size_t tile_count() const { return used_; }

 private:
  struct Tile {
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::uint64_t rows[64] = {};
  };

  Tile& tile_at(std::int64_t x, std::int64_t y) {
    if (recent_ != kNone && tiles_[recent_].x == x && tiles_[recent_].y == y) return tiles_[recent_];
    return find_or_add(x, y);
  }
  Tile& find_or_add(std::int64_t x, std::int64_t y);
  std::size_t slot(std::int64_t x, std::int64_t y) const;

  static constexpr std::uint32_t kNone = 0xffffffff;

  std::vector<Tile> tiles_;  ///< the first `used_` are in the grid, the others wait
  std::vector<std::uint32_t> table_;
  std::size_t used_ = 0;
  std::uint32_t recent_ = kNone;
};

}  // namespace lamina::engine
