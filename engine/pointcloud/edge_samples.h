#pragma once

#include <vector>

#include "engine/nurbs/bezier_chain.h"
#include "engine/nurbs/surface.h"

namespace lamina::engine {

/// A trim curve lifted onto its surface at one parameter.
struct EdgeSample {
  double t = 0.0;
  Vector2 parameters;  ///< (u, v)
  Vector3 position;    ///< mm
};

/// Samples along a trim curve, both ends included, whose chords in the parameter plane are within `tolerance`
/// of it, and short enough to show how the surface bends between them: a quarter of a knot span along the
/// directions in which it does. Where the curve is highest or lowest there is a sample, too, so that a plane
/// just below does not miss it.
std::vector<EdgeSample> edge_samples(const NurbsSurface& surface, const BezierChain& curve, double tolerance);

}  // namespace lamina::engine
