#pragma once

#include <array>
#include <optional>

#include "engine/nurbs/surface.h"

namespace lamina::engine {

/// A side of the parameter rectangle.
enum class Side { kFirstU, kLastU, kFirstV, kLastV };

/// How the sides of a surface's parameter rectangle meet in space.
struct SurfaceTopology {
  double period_u = 0.0;  ///< length of the domain where the surface closes in u, else 0
  double period_v = 0.0;
  std::array<std::optional<Vector3>, 4> poles;  ///< by Side: the point that a whole side shrinks to
  double size = 0.0;                            ///< diagonal of the box around the control points

  /// The side whose pole lies within `tolerance` of the point.
  std::optional<Side> pole_at(const Vector3& point, double tolerance) const;
};

/// Judges by points along the sides, which count as the same within `tolerance`.
SurfaceTopology surface_topology(const NurbsSurface& surface, double tolerance);

/// The surface cut along u = `first_u`, anywhere in its domain, and put together again along its old seam:
/// the same points on [first_u, first_u + period]. It must close in u.
NurbsSurface with_seam_at_u(const NurbsSurface& surface, double first_u);

}  // namespace lamina::engine
