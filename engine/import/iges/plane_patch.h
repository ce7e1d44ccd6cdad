#pragma once

#include <vector>

#include "engine/nurbs/surface.h"

namespace lamina::engine {

/// The piece of a plane, given by a point and its normal (any length but zero), that the feet of all points
/// lie in, with some room around; u and v are lengths, the normal is that of u x v.
NurbsSurface plane_patch(const Vector3& origin, const Vector3& normal, const std::vector<Vector3>& cover);

}  // namespace lamina::engine
