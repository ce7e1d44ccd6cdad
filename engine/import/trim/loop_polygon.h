#pragma once

#include <vector>

#include "engine/geometry/polygon.h"
#include "engine/nurbs/curve.h"

namespace lamina::engine {

/// Points along a loop of parameter-plane curves, `per_span` for each span that is not straight.
Loop loop_polygon(const std::vector<NurbsCurve>& curves, int per_span = 8);

/// Whether a point is inside, by parity.
bool is_inside(const Loop& polygon, const Vector2& point);

}  // namespace lamina::engine
