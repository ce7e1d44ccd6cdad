#pragma once

#include <vector>

#include "engine/import/trim/surface_inverse.h"
#include "engine/import/trim/surface_topology.h"
#include "engine/nurbs/curve.h"

namespace lamina::engine {

/// A loop in the parameter plane of a surface (control points (w u, w v, 0, w)), with its parameters
/// unwrapped: where the surface closes they go on beyond the domain, so that curves follow each other without
/// a jump.
struct ParameterLoop {
  std::vector<NurbsCurve> curves;
  int turns_u = 0;  ///< periods by which the end lies beyond the start
  int turns_v = 0;
  double largest_gap = 0.0;       ///< between neighbouring curves as given, in space
  double largest_distance = 0.0;  ///< of a projected curve from the surface
};

/// What loops are built on; all must outlive the building.
struct LoopGround {
  const NurbsSurface& surface;
  const SurfaceTopology& topology;
  const SurfaceInverse& inverse;
  double tolerance;  ///< points closer than this count as one; projected curves are as good as this
};

/// Curves of the parameter plane as a loop: turned round and moved by periods where that makes them meet.
/// Gaps up to the tolerance vanish, larger ones are bridged straight.
ParameterLoop chained_loop(const std::vector<NurbsCurve>& curves, const LoopGround& ground);

/// Curves in space, one after the other, projected onto the surface. Where they pass a pole of a closed
/// surface, the loop goes along the pole's side so that the surface's part inside lies to the left.
ParameterLoop projected_loop(const std::vector<NurbsCurve>& edges, const LoopGround& ground);

/// Straight line of the parameter plane.
NurbsCurve parameter_line(const Vector2& start, const Vector2& end);

/// Ends of a curve of the parameter plane.
Vector2 parameter_start(const NurbsCurve& parameter_curve);
Vector2 parameter_end(const NurbsCurve& parameter_curve);

/// The same curve moved in the parameter plane.
NurbsCurve moved(NurbsCurve parameter_curve, const Vector2& by);

}  // namespace lamina::engine
