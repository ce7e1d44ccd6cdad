#pragma once

#include <cstddef>
#include <vector>

#include "engine/geometry/planar_curve.h"
#include "engine/geometry/vector.h"
#include "engine/slice_plane.h"

namespace lamina::reference {

using namespace engine;

/// A contour that bounds area: its curve ends where it begins. No orientation is promised; contours nest by
/// parity.
struct ClosedContour {
  PlanarCurve curve;
  bool touch = false;  ///< The plane only grazes the model along this curve (dissertation p. 158).
};

/// A contour with two ends: where the plane grazes the model, or where the model itself is open.
struct OpenContour {
  PlanarCurve curve;
  bool touch = false;
};

/// A face of the model that lies in the plane: filled between the outer and the inner curves.
struct PlanarContour {
  PlanarCurve outer;
  std::vector<PlanarCurve> inner;
};

/// A single point where the plane touches the model, such as the top of a sphere.
struct TouchPoint {
  Vector2 position;
};

/// What was counted and what was imperfect while one layer was made.
struct LayerReport {
  std::size_t active_patches = 0;  ///< patches on the active list
  std::size_t patches_added = 0;
  std::size_t patches_removed = 0;
  std::size_t points_near_plane = 0;  ///< samples within epsilon of the plane
  std::size_t points_held = 0;        ///< samples of every active patch
  std::size_t grid_cells = 0;
  std::size_t strong_cells = 0;
  std::size_t boundary_cells = 0;
  std::size_t components = 0;
  std::size_t control_points = 0;
  std::size_t unfitted_curves =
      0;                          ///< curves that reached the fit's limit and are polylines through the cells
  std::size_t dropped_spurs = 0;  ///< boundary cells left aside as dead ends while tracing
};

/// What one slicing plane and the model have in common.
struct Layer {
  std::size_t index = 0;
  SlicePlane plane;
  std::vector<ClosedContour> closed;
  std::vector<OpenContour> open;
  std::vector<PlanarContour> planar;
  std::vector<TouchPoint> points;
  LayerReport report;
};

}  // namespace lamina::reference
