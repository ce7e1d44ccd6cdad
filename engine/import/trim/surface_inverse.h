#pragma once

#include <vector>

#include "engine/import/trim/surface_topology.h"
#include "engine/nurbs/surface.h"

namespace lamina::engine {

/// Finds the parameters of points near a surface. In a direction in which the surface closes, parameters go
/// on beyond the domain, a period for each turn. Not for several threads at once.
class SurfaceInverse {
 public:
  /// Both must outlive this.
  SurfaceInverse(const NurbsSurface& surface, const SurfaceTopology& topology);

  /// Parameters of the foot of a point, and its distance.
  struct Foot {
    Vector2 at = Vector2::Zero();
    double distance = 0.0;
  };

  /// The nearest foot: Newton's method (The NURBS Book, section 6.1) from the best points of a grid.
  Foot nearest(const Vector3& point) const;

  /// The foot near `hint` where it is not farther than `trusted` (or rounding) from the point, else the
  /// nearest one where that is less than half as far. Parameters of closed directions are the ones closest to
  /// the hint.
  Foot nearest(const Vector3& point, const Vector2& hint, double trusted = 0.0) const;

  /// Parameters inside the domain: whole periods taken off, what is still beyond it moved to its side.
  Vector2 inside(const Vector2& at) const;

  /// Point of the surface; parameters as above.
  Vector3 point(const Vector2& at) const;

  /// Length in space, to first order, of a step `by` from parameters `at`.
  double step_length(const Vector2& at, const Vector2& by) const;

  /// Parameters moved by whole periods so that they are closest to `other`.
  Vector2 moved_near(Vector2 at, const Vector2& other) const;

 private:
  struct GridPoint {
    Vector2 at;
    Vector3 point;
  };

  Foot refined(const Vector3& point, Vector2 at) const;

  /// As `inside`, but parameters of closed directions stay as they are.
  Vector2 kept_inside(const Vector2& at) const;

  void make_grid() const;

  const NurbsSurface& surface_;
  const SurfaceTopology& topology_;
  double period_u_;
  double period_v_;
  double size_;
  mutable std::vector<GridPoint> grid_;        ///< made when it is first needed
  mutable Vector2 spacing_ = Vector2::Zero();  ///< of the grid at its widest
};

}  // namespace lamina::engine
