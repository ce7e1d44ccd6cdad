#pragma once

#include <variant>

#include "engine/geometry/planar_curve.h"
#include "engine/geometry/vector.h"

namespace lamina::engine {

struct LineSegment {
  Vector2 start = Vector2::Zero();
  Vector2 end = Vector2::Zero();
};

/// Part of a circle, mm. Both ends lie on the circle to the recognition tolerance; they are met exactly, the
/// radius in between runs linearly from the one end's to the other's.
struct CircularArc {
  Vector2 start = Vector2::Zero();
  Vector2 end = Vector2::Zero();
  Vector2 centre = Vector2::Zero();
  double sweep = 0.0;  ///< rad, in (-2 pi, 2 pi), not zero; positive is counter-clockwise

  double radius() const { return (start - centre).norm(); }
};

/// One smooth piece of a contour.
using CurvePiece = std::variant<LineSegment, CircularArc, PlanarCurve>;

Vector2 start_point(const CurvePiece& piece);
Vector2 end_point(const CurvePiece& piece);

/// Point at u in [0, 1]; the ends are met exactly.
Vector2 point_on(const CurvePiece& piece, double u);

/// A point of a piece and the derivative by u there.
struct PointAndDerivative {
  Vector2 point = Vector2::Zero();
  Vector2 derivative = Vector2::Zero();
};
PointAndDerivative point_and_derivative(const CurvePiece& piece, double u);

/// Arc length, mm. Exact for lines and arcs, to 1e-9 of itself for splines (adaptive Gauss quadrature).
double length(const CurvePiece& piece);

/// A box that contains the piece; the smallest one for lines and arcs, the control points' for splines.
Box2 bounds(const CurvePiece& piece);

/// One half of the integral of x dy - y dx along the piece, mm^2: the area that the ray from the origin
/// sweeps, positive counter-clockwise. Closed form for lines and arcs, Gauss quadrature of sufficient order
/// for splines: exact up to rounding for degrees to 5.
double swept_area(const CurvePiece& piece);

/// Unit tangents where the piece begins and ends.
Vector2 start_tangent(const CurvePiece& piece);
Vector2 end_tangent(const CurvePiece& piece);

}  // namespace lamina::engine
