#pragma once

#include <vector>

#include "engine/geometry/bspline_basis.h"
#include "engine/geometry/vector.h"

namespace lamina::engine {

/// A rational B-spline curve in space, mm. Control points are homogeneous: (w x, w y, w z, w) with w > 0.
/// Invariant: knots.size() == control_points.size() + degree + 1. Not necessarily clamped.
struct NurbsCurve {
  int degree = 1;
  Knots knots;
  std::vector<Vector4> control_points;

  double first_parameter() const { return knots[static_cast<std::size_t>(degree)]; }
  double last_parameter() const { return knots[knots.size() - 1 - static_cast<std::size_t>(degree)]; }
};

/// Point at parameter t of the curve's domain. The NURBS Book, A4.1.
Vector3 evaluate(const NurbsCurve& curve, double t);

/// A curve point with its derivative.
struct CurveDerivative {
  Vector3 point;
  Vector3 tangent;
};

/// Point and first derivative at t. The NURBS Book, A3.2 and equation 4.8.
CurveDerivative evaluate_derivative(const NurbsCurve& curve, double t);

/// Homogeneous control point of a Cartesian point and its weight.
inline Vector4 homogeneous(const Vector3& point, double weight = 1.0) {
  return {point.x() * weight, point.y() * weight, point.z() * weight, weight};
}

/// Cartesian point of a homogeneous one.
inline Vector3 cartesian(const Vector4& point) {
  return point.head<3>() / point.w();
}

}  // namespace lamina::engine
