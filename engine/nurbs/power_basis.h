#pragma once

#include <vector>

#include "engine/geometry/vector.h"

namespace lamina::engine {

/// Bezier control points of the polynomial sum_k coefficients[k] s^k for s in [0, length]: as many points as
/// coefficients (at least one). Exact up to rounding. The NURBS Book, section 6.6.
std::vector<Vector3> bezier_from_power(const std::vector<Vector3>& coefficients, double length);

}  // namespace lamina::engine
