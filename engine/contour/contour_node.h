#pragma once

#include <vector>

#include "engine/geometry/vector.h"

namespace lamina::engine {

/// A point of a contour, on the model's surface and in the slicing plane, mm.
struct ContourNode {
  Vector2 position = Vector2::Zero();
  Vector2 tangent_in =
      Vector2::Zero();  ///< unit tangent arriving along the contour's direction; zero when unknown
  Vector2 tangent_out = Vector2::Zero();  ///< unit tangent leaving; differs from `tangent_in` at a corner
  bool corner = false;                    ///< the curve may turn here: a fit must not smooth over it
  bool exact = true;                      ///< false: beside a bridged gap, where the model has no point
};

/// Nodes in walking order. A closed chain's last node joins its first, which is not repeated.
struct NodeChain {
  std::vector<ContourNode> nodes;
  bool closed = false;
  /// Length along which the surfaces' normals point to its right, less that along which they point to its
  /// left, mm; 0 when unknown.
  double normals_right = 0.0;
};

}  // namespace lamina::engine
