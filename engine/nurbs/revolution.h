#pragma once

#include "engine/nurbs/curve.h"
#include "engine/nurbs/surface.h"

namespace lamina::engine {

/// The surface swept by a curve that turns about an axis from the angle `first` to `last` (rad, first < last,
/// at most a full turn), counter-clockwise about the axis direction (any length but zero), angle 0 where the
/// curve is given. u runs along the curve with its parameters, v is the angle at every knot. Exact up to
/// rounding. The NURBS Book, A8.1.
NurbsSurface surface_of_revolution(const NurbsCurve& generatrix, const Vector3& axis_point,
                                   const Vector3& axis_direction, double first, double last);

}  // namespace lamina::engine
