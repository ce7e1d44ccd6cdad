#include "tests/reference/grid/polyomino.h"

#include <array>
#include <cstdint>

namespace lamina::reference {
namespace {

/// A three-by-three mask without its centre: bit k for neighbour k of kMooreNeighbours.
using Mask = std::uint8_t;

constexpr Mask bit(int neighbour) {
  return static_cast<Mask>(1U << static_cast<unsigned>(neighbour % 8));
}

/// In each of four rotations the two arms of an angle, alone or with one arm bent away at its end.
constexpr std::array<bool, 256> make_polyominoes() {
  std::array<bool, 256> table{};
  for (int arm = 0; arm < 8; arm += 2) {
    const auto angle = static_cast<Mask>(bit(arm) | bit(arm + 2));
    table[angle] = true;
    table[static_cast<Mask>(angle | bit(arm + 7))] = true;
    table[static_cast<Mask>(angle | bit(arm + 3))] = true;
  }
  return table;
}

constexpr std::array<bool, 256> kPolyominoes = make_polyominoes();

Mask mask_around(const LayerGrid& grid, Cell cell, CellState line) {
  unsigned mask = 0;
  for (int k = 0; k < 8; ++k) {
    if (grid.state(cell + kMooreNeighbours[k]) == line) mask |= bit(k);
  }
  return static_cast<Mask>(mask);
}

}  // namespace

std::size_t eliminate_polyominoes(LayerGrid& grid, CellState line) {
  std::size_t eliminated = 0;
  std::size_t kept = 0;
  Cell floating;
  std::size_t floating_count = 0;
  const auto eliminate = [&](Cell cell) {
    grid.set(cell, CellState::kRepairedExterior);
    ++eliminated;
  };
  for (std::ptrdiff_t y = 0; y < grid.rows(); ++y) {
    for (std::ptrdiff_t x = 0; x < grid.columns(); ++x) {
      const Cell cell{x, y};
      if (grid.state(cell) != line) continue;
      const Mask mask = mask_around(grid, cell, line);
      if (mask == 0) {
        // The first floating cell stays until it is known whether there is anything else: it may be a touch
        // point.
        if (floating_count++ == 0) {
          floating = cell;
        } else {
          eliminate(cell);
        }
      } else if (kPolyominoes[mask]) {
        eliminate(cell);
      } else {
        ++kept;
      }
    }
  }
  if (floating_count > 0 && kept > 0) eliminate(floating);
  return eliminated;
}

}  // namespace lamina::reference
