#pragma once

#include <functional>
#include <vector>

#include "engine/nurbs/curve.h"

namespace lamina::engine {

/// A way through a parameter plane: its point at t.
using ParameterPath = std::function<Vector2(double)>;

/// Length in space of a step from a point of a parameter plane.
using StepLength = std::function<double(const Vector2& at, const Vector2& by)>;

/// The path on [breaks.front(), breaks.back()] as one curve in the plane z = 0: straight where that is within
/// `tolerance` (measured by `length`), else cubics through four points each, halved until they keep it at
/// three points between these (at most twelve times). `breaks` are where the path may have corners.
NurbsCurve fitted_path(const ParameterPath& path, const std::vector<double>& breaks, const StepLength& length,
                       double tolerance);

}  // namespace lamina::engine
