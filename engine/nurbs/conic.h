#pragma once

#include <optional>

#include "engine/geometry/vector.h"
#include "engine/nurbs/curve.h"

namespace lamina::engine {

/// The conic a x^2 + b x y + c y^2 + d x + e y + f = 0.
struct Conic {
  double a = 0.0;
  double b = 0.0;
  double c = 0.0;
  double d = 0.0;
  double e = 0.0;
  double f = 0.0;
};

/// kDegenerate: lines, a point or nothing.
enum class ConicKind { kEllipse, kParabola, kHyperbola, kDegenerate };

/// Which conic the coefficients describe, by the signs of its invariants; coefficients are compared after
/// scaling, so that a quadratic part singular to 1e-10 of its size is a parabola's.
ConicKind classify(const Conic& conic);

/// Distance of a point from the conic to first order: |q(p)| / |grad q(p)|.
double distance_to(const Conic& conic, const Vector2& point);

/// The arc of the conic from `start` to `end`, both on it, in the plane z. Of an ellipse the
/// counter-clockwise arc, the whole ellipse where start equals end; its knots are eccentric angles. Of a
/// parabola or hyperbola the piece between the points, on [0, 1]. All weights positive, exact up to rounding.
/// Nothing where no such arc exists: the conic is degenerate, the points are equal (parabola, hyperbola) or
/// on different branches. The NURBS Book, sections 7.3 to 7.6.
std::optional<NurbsCurve> conic_arc(const Conic& conic, const Vector2& start, const Vector2& end, double z);

}  // namespace lamina::engine
