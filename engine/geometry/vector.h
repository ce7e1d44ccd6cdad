#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace lamina::engine {

using Vector2 = Eigen::Vector2d;  ///< A point or direction inside a layer, mm.
using Vector3 = Eigen::Vector3d;  ///< A point or direction in model space, mm.
using Vector4 = Eigen::Vector4d;  ///< Homogeneous coordinates (w x, w y, w z, w) of a rational control point.

using Box2 = Eigen::AlignedBox2d;  ///< Axis-aligned, closed; `isEmpty()` until extended.
using Box3 = Eigen::AlignedBox3d;

}  // namespace lamina::engine
