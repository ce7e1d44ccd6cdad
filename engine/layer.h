#pragma once

#include <cstddef>
#include <vector>

#include "engine/geometry/piece_curve.h"
#include "engine/geometry/vector.h"
#include "engine/layer_report.h"
#include "engine/slice_plane.h"

namespace lamina::engine {

/// A contour that bounds area: its curve ends where it begins, `closed` is set in it. No orientation is
/// promised; contours nest by parity.
struct ClosedContour {
  PieceCurve curve;
  bool touch = false;  ///< The plane only grazes the model along this curve (dissertation p. 158).
};

/// A contour with two ends: where the plane grazes the model, or where the model itself is open.
struct OpenContour {
  PieceCurve curve;
  bool touch = false;
};

/// A face of the model that lies in the plane: filled between the outer and the inner curves.
struct PlanarContour {
  PieceCurve outer;
  std::vector<PieceCurve> inner;
};

/// A single point where the plane touches the model, such as the top of a sphere.
struct TouchPoint {
  Vector2 position;
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

}  // namespace lamina::engine
