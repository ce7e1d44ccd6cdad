#pragma once

#include <vector>

#include "tests/reference/grid/layer_grid.h"

namespace lamina::reference {

using namespace engine;

/// Empty cells kept around a component in its own grid (dissertation p. 141).
inline constexpr std::ptrdiff_t kComponentMargin = 3;

/// The strong cells of one intersection, and what lies beside them.
struct Component {
  std::vector<Cell> cells;     ///< places in the layer grid
  bool touches_above = false;  ///< a cell with points only above lies in the neighbourhood
  bool touches_below = false;
  bool crossed = false;  ///< somewhere the model passes right through the plane

  /// The plane only grazes the model here: there is surface on one side of it, not on the other
  /// (dissertation p. 158). A surface that stands upright on the plane leaves no mark on either side.
  ///
  /// One condition goes beyond the dissertation, whose rule would also take a wall for a touch when the only
  /// one-sided cells beside it are those of a floor within epsilon of the plane: the model must pass right
  /// through it nowhere.
  bool touch() const { return touches_above != touches_below && !crossed; }
};

/// Splits the strong cells into sets that are connected by the Moore neighbourhood, in order of their first
/// cell, row by row from the lower left (dissertation p. 141 to 145).
std::vector<Component> separate(const LayerGrid& layer_grid);

/// A component's cells alone, in a grid of their own with `kComponentMargin` empty cells on each side.
LayerGrid component_grid(const LayerGrid& layer_grid, const Component& component);

}  // namespace lamina::reference
