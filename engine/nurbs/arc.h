#pragma once

#include <vector>

#include "engine/nurbs/curve.h"

namespace lamina::engine {

/// Angles from `first` to `last` (rad, first < last), evenly spaced, neighbours at most a quarter turn apart:
/// where a rational quadratic arc is split.
std::vector<double> arc_breaks(double first, double last);

/// The ellipse arc center + cos(t) x_axis + sin(t) y_axis for t from `first` to `last` (rad, first < last, at
/// most a full turn) as rational quadratics with positive weights; a circle arc where the axes are orthogonal
/// and equally long. The knots are angles, so that the curve passes the angle t exactly at every break and
/// within 0.02 rad of it between. Exact up to rounding. The NURBS Book, A7.1, which is affinely invariant.
NurbsCurve ellipse_arc(const Vector3& center, const Vector3& x_axis, const Vector3& y_axis, double first,
                       double last);

}  // namespace lamina::engine
