#pragma once

#include <vector>

#include "tests/reference/contour/fit.h"
#include "tests/reference/grid/layer_grid.h"
#include "tests/reference/layer.h"

namespace lamina::reference {

using namespace engine;

/// The contours of one component and what was counted on the way.
struct ComponentContours {
  std::vector<ClosedContour> closed;
  std::vector<OpenContour> open;
  std::vector<PlanarContour> planar;
  std::vector<TouchPoint> points;
  std::size_t boundary_cells = 0;
  std::size_t unfitted_curves = 0;
  std::size_t dropped_spurs = 0;
};

/// From a component's own grid, strong cells only, to its contours: boundary cells, planar case, polyominoes,
/// tracing and fit. A single cell is a touch point; a chain that ends where it began is a closed contour, any
/// other an open one; a face in the plane is a planar contour with its holes. `touch` says that the plane
/// only grazes the model here (dissertation p. 156 to 160).
ComponentContours make_contours(LayerGrid grid, bool touch, const FitOptions& options);

}  // namespace lamina::reference
