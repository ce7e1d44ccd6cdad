#pragma once

#include "tests/reference/grid/layer_grid.h"

namespace lamina::reference {

using namespace engine;

/// What the inside of a component turned out to be.
enum class PlanarCase {
  kNone,           ///< a curve around empty cells
  kNothingInside,  ///< a curve around nothing: a line of strong cells, thick or thin
  kWithoutHoles,   ///< a face in the plane
  kWithHoles,      ///< a face in the plane with holes, whose rims are interior boundary cells
};

/// Tells the planar touch from its false positive, once the boundary cells are known (dissertation p. 159).
/// Every empty region inside the boundary is filled; strong cells beside it become interior boundary cells.
/// If a fill reaches a boundary cell, the boundary is no wider than a curve there and there is no face. What
/// lies between boundary and interior boundary becomes planar.
///
/// One condition goes beyond the dissertation, whose rule would also take a curve that is two cells wide all
/// around for a narrow ring: a face needs a cell that is in the plane together with all its neighbours.
PlanarCase identify_planar(LayerGrid& grid);

}  // namespace lamina::reference
