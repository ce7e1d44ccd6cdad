#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/geometry/vector.h"
#include "engine/model.h"

namespace lamina::reference {

using namespace engine;

/// States of a cell of the layer grid (dissertation, table 6.3).
enum class CellState : std::uint8_t {
  kEmptyPoint,        ///< no points in the cell
  kBelowPoint,        ///< points below the plane
  kAbovePoint,        ///< points above the plane
  kStrongPoint,       ///< points above and below
  kExterior,          ///< outside an intersection
  kBoundary,          ///< on an intersection
  kInteriorBoundary,  ///< on an intersection inside a planar touch
  kPlanar,            ///< inside a planar touch: to be filled
  kRepairedExterior,  ///< a boundary cell that was not needed
  kOutsideGrid,       ///< no such cell
};

/// A cell's place in its grid: column and row.
struct Cell {
  std::ptrdiff_t x = 0;
  std::ptrdiff_t y = 0;
  bool operator==(const Cell&) const = default;
};

/// The eight neighbours of a cell, clockwise from the one above (Moore neighbourhood).
inline constexpr Cell kMooreNeighbours[8] = {{0, 1},  {1, 1},   {1, 0},  {1, -1},
                                             {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}};

/// The four neighbours that share a side.
inline constexpr Cell kSideNeighbours[4] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}};

inline Cell operator+(Cell a, Cell b) {
  return {a.x + b.x, a.y + b.y};
}

/// The addressable layer grid: square cells of side epsilon over one slicing plane, dense, row by row
/// (dissertation p. 136).
class LayerGrid {
 public:
  /// All cells empty. `origin` is the lower left corner of cell (0, 0), mm; `epsilon` the side of a cell, mm.
  LayerGrid(const Vector2& origin, double epsilon, std::ptrdiff_t columns, std::ptrdiff_t rows);

  /// A grid that covers the box, every side of which is moved out by the model tolerance: a point on a cell's
  /// edge then falls into the same cell whichever way it was rounded.
  static LayerGrid covering(const Box2& box, double epsilon);

  std::ptrdiff_t columns() const { return columns_; }
  std::ptrdiff_t rows() const { return rows_; }
  double epsilon() const { return epsilon_; }
  const Vector2& origin() const { return origin_; }

  bool contains(Cell cell) const { return cell.x >= 0 && cell.y >= 0 && cell.x < columns_ && cell.y < rows_; }

  /// `kOutsideGrid` where there is no such cell.
  CellState state(Cell cell) const {
    return contains(cell) ? static_cast<CellState>(cells_[index(cell)] & kStateBits)
                          : CellState::kOutsideGrid;
  }
  void set(Cell cell, CellState state) {
    std::uint8_t& stored = cells_[index(cell)];
    stored = static_cast<std::uint8_t>((stored & ~kStateBits) | static_cast<std::uint8_t>(state));
  }

  /// Whether a point of the model lies in the plane itself, to the model tolerance, in this cell: what tells
  /// a planar face from a steep one.
  bool in_plane(Cell cell) const { return contains(cell) && (cells_[index(cell)] & kInPlaneBit) != 0; }
  void set_in_plane(Cell cell) { cells_[index(cell)] |= kInPlaneBit; }

  /// Whether the model passes right through the plane in this cell, from well above it to well below: what
  /// tells a section from a touch. `mark_points` says how far is well.
  bool crossed(Cell cell) const {
    return contains(cell) && (cells_[index(cell)] & kCrossedBits) == kCrossedBits;
  }
  void set_well_above(Cell cell) { cells_[index(cell)] |= kWellAboveBit; }
  void set_well_below(Cell cell) { cells_[index(cell)] |= kWellBelowBit; }

  /// Lets two neighbouring cells count as one for `crossed`.
  void share_crossing(Cell a, Cell b) {
    const auto bits = static_cast<std::uint8_t>((cells_[index(a)] | cells_[index(b)]) & kCrossedBits);
    cells_[index(a)] |= bits;
    cells_[index(b)] |= bits;
  }

  /// The cell that a point falls into; the point must lie over the grid.
  Cell cell_at(const Vector2& point) const;

  /// The place that stands for a cell: its lower left corner (dissertation p. 150).
  Vector2 location(Cell cell) const {
    return origin_ + epsilon_ * Vector2(static_cast<double>(cell.x), static_cast<double>(cell.y));
  }

 private:
  static constexpr std::uint8_t kStateBits = 0x0f;
  static constexpr std::uint8_t kInPlaneBit = 0x10;
  static constexpr std::uint8_t kWellAboveBit = 0x20;
  static constexpr std::uint8_t kWellBelowBit = 0x40;
  static constexpr std::uint8_t kCrossedBits = kWellAboveBit | kWellBelowBit;

  std::size_t index(Cell cell) const { return static_cast<std::size_t>(cell.y * columns_ + cell.x); }

  Vector2 origin_;
  double epsilon_;
  std::ptrdiff_t columns_;
  std::ptrdiff_t rows_;
  std::vector<std::uint8_t> cells_;
};

}  // namespace lamina::reference
