#pragma once

#include <vector>

#include "engine/geometry/bspline_basis.h"
#include "engine/geometry/polygon.h"
#include "engine/geometry/vector.h"

namespace lamina::engine {

/// A polynomial B-spline curve inside a slicing plane, mm. Clamped: it starts at its first control point and
/// ends at its last. Invariant: knots.size() == control_points.size() + degree + 1.
struct PlanarCurve {
  int degree = 1;
  Knots knots;
  std::vector<Vector2> control_points;

  double first_parameter() const { return knots[static_cast<std::size_t>(degree)]; }
  double last_parameter() const { return knots[knots.size() - 1 - static_cast<std::size_t>(degree)]; }
};

/// Point at parameter t of the curve's domain.
Vector2 evaluate(const PlanarCurve& curve, double t);

/// First derivative with respect to the parameter.
Vector2 evaluate_derivative(const PlanarCurve& curve, double t);

/// Points along the curve, both ends included, such that no point of the curve is farther than `tolerance`
/// (mm, positive) from the chain. Knot spans are cut into chords by the bound of the second derivative over
/// the chord, (1/8) h^2 max|C''| (de Boor, A Practical Guide to Splines, on broken-line interpolation).
Polyline flatten(const PlanarCurve& curve, double tolerance);

/// Smallest box around the control points; it contains the curve (convex-hull property).
Box2 control_box(const PlanarCurve& curve);

}  // namespace lamina::engine
