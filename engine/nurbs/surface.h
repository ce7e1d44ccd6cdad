#pragma once

#include <cstddef>
#include <vector>

#include "engine/geometry/bspline_basis.h"
#include "engine/geometry/vector.h"
#include "engine/nurbs/curve.h"

namespace lamina::engine {

/// A rectangular net of homogeneous control points (w x, w y, w z, w), w > 0. Rows run along u, columns along
/// v.
struct ControlNet {
  std::size_t count_u = 0;
  std::size_t count_v = 0;
  std::vector<Vector4> points;  ///< count_u * count_v of them, v fastest

  Vector4& at(std::size_t i, std::size_t j) { return points[i * count_v + j]; }
  const Vector4& at(std::size_t i, std::size_t j) const { return points[i * count_v + j]; }
};

/// A rational B-spline surface, mm. Invariants: knots_u.size() == net.count_u + degree_u + 1, the same for v.
/// Not necessarily clamped.
struct NurbsSurface {
  int degree_u = 1;
  int degree_v = 1;
  Knots knots_u;
  Knots knots_v;
  ControlNet net;

  double first_u() const { return knots_u[static_cast<std::size_t>(degree_u)]; }
  double last_u() const { return knots_u[knots_u.size() - 1 - static_cast<std::size_t>(degree_u)]; }
  double first_v() const { return knots_v[static_cast<std::size_t>(degree_v)]; }
  double last_v() const { return knots_v[knots_v.size() - 1 - static_cast<std::size_t>(degree_v)]; }
};

/// A surface point with its first and second partial derivatives.
struct SurfaceDerivatives {
  Vector3 point;
  Vector3 du;
  Vector3 dv;
  Vector3 duu;
  Vector3 duv;
  Vector3 dvv;
};

/// Point at (u, v) of the domain. The NURBS Book, A4.3.
Vector3 evaluate(const NurbsSurface& surface, double u, double v);

/// Point and partial derivatives up to the second. The NURBS Book, A3.6 and A4.4.
SurfaceDerivatives evaluate_derivatives(const NurbsSurface& surface, double u, double v);

/// The curve along v at u: a point of the domain. The NURBS Book, section 4.4.
NurbsCurve isoparametric_curve(const NurbsSurface& surface, double u);

/// Smallest box around the control points; it contains the surface (convex-hull property, weights positive).
Box3 control_box(const ControlNet& net);

/// The same surface with u and v exchanged.
NurbsSurface transposed(const NurbsSurface& surface);

}  // namespace lamina::engine
