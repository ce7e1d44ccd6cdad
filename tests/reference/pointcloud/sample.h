#pragma once

#include <vector>

#include "engine/nurbs/bezier.h"

namespace lamina::reference {

using namespace engine;

struct SampleOptions {
  double epsilon = 0.05;  ///< greatest distance between neighbouring points, mm
  double oversampling =
      2.0;  ///< C_over; at 2 a cell that the surface crosses flatly never stays without a point
};

/// The point cloud of one patch: a grid of ceil(extent * C_over / epsilon) intervals each way, then every
/// parametric quad whose four corners are not all within epsilon of each other (six distances) is quartered,
/// recursively (dissertation p. 131). Edge points that neighbouring quads share are stored by each.
std::vector<Vector3> sample(const BezierPatch& patch, const SampleOptions& options);

}  // namespace lamina::reference
