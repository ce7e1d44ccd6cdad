#pragma once

#include "engine/geometry/bspline_basis.h"
#include "engine/geometry/vector.h"
#include "engine/pointcloud/front_state.h"
#include "engine/pointcloud/section_arc.h"

namespace lamina::engine {

/// Highest degree that is sliced.
inline constexpr int kHighestPatchDegree = kHighestDegree;

enum class Direction { kU, kV };

inline Direction other(Direction direction) {
  return direction == Direction::kU ? Direction::kV : Direction::kU;
}

/// (u, v) where one is held and the other is free.
inline Vector2 parameters_on(Direction held, double at, double free) {
  return held == Direction::kU ? Vector2(at, free) : Vector2(free, at);
}

/// Values of the degree + 1 Bernstein polynomials at t and their derivatives (The NURBS Book, A1.3 and
/// equation 1.9).
struct BernsteinPair {
  double value[kHighestPatchDegree + 1];
  double derivative[kHighestPatchDegree + 1];

  BernsteinPair(int degree, double t);
};

/// A point of a patch and the derivatives along its own parameters, each 0 to 1.
struct PatchPoint {
  Vector3 position;
  Vector3 du;
  Vector3 dv;
};

PatchPoint point_at(const FrontPatch& patch, const Vector2& parameters);

/// Direction of a plane's section where a surface has these derivatives: the outward normal lies on its
/// right. Zero where the surface is level or has no normal.
Vector2 section_tangent(const Vector3& du, const Vector3& dv);

/// Where along one parameter line, the other parameter held, the patch meets the plane. Between `low` and
/// `high` its height crosses the plane once, upwards when `rising`.
struct LineCrossing {
  Direction held = Direction::kU;
  double at = 0.0;  ///< value of the parameter held
  double low = 0.0;
  double high = 1.0;
  bool rising = true;
  double guess = -1.0;  ///< where it is looked for first; the middle when not between `low` and `high`
};

struct CrossingPoint {
  SectionNode node;  ///< its tangent has the solid on the left where the surface normal points out of it
  double parameter = 0.0;  ///< of the direction not held
  double slope = 0.0;      ///< its derivative by the parameter held, along the section
};

/// By Newton steps kept inside the bracket, to the last bits of the parameter: the point is on the surface,
/// and on the plane to about 1e-15 of the size of the patch.
CrossingPoint crossing_on_line(const FrontPatch& patch, double z, const LineCrossing& line);

/// Point of the patch, and its derivative along one direction, both seen from above.
struct EdgePoint {
  Vector2 position;
  Vector2 derivative;
  double normal_z = 0.0;  ///< |z component| of the unit normal; 0 where the patch has none

  /// Whether the patch stands upright here, to about a degree.
  bool upright() const { return normal_z < 0.02; }
};

EdgePoint point_on_line(const FrontPatch& patch, Direction held, double at, double parameter);

}  // namespace lamina::engine
