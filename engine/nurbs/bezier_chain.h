#pragma once

#include <vector>

#include "engine/nurbs/curve.h"

namespace lamina::engine {

/// A curve as rational Bezier segments end to end: segment k lives on [breaks[k], breaks[k + 1]] and has the
/// control points k * degree ... k * degree + degree; neighbours share one. Invariant: control_points.size()
/// == (breaks.size() - 1) * degree + 1.
struct BezierChain {
  int degree = 1;
  std::vector<double> breaks;
  std::vector<Vector4> control_points;
};

/// The curve cut at `breaks`: ascending, inside the domain, and every knot between the first and the last of
/// them among them. Linear in the number of segments, clamped or not. By blossoms (Ramshaw; The NURBS Book,
/// section 5.2, has the same as repeated insertion).
BezierChain bezier_chain(const NurbsCurve& curve, const std::vector<double>& breaks);

/// The curve cut at its own knots.
BezierChain bezier_chain(const NurbsCurve& curve);

/// Point at parameter t of the chain's domain; a parameter beyond it continues the segment at that end.
/// Linear in the degree.
Vector3 evaluate(const BezierChain& chain, double t);

/// The same with the first derivative.
CurveDerivative evaluate_derivative(const BezierChain& chain, double t);

/// The chain as one clamped curve; inner knots have the multiplicity of the degree.
NurbsCurve to_curve(const BezierChain& chain);

}  // namespace lamina::engine
