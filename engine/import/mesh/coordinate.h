#pragma once

#include "engine/geometry/vector.h"

namespace lamina::engine {

/// Coordinates beyond this (a thousand kilometres, in mm) are no model.
inline constexpr float kLargestMeshCoordinate = 1e9F;

/// Whether all coordinates are numbers within bounds.
inline bool is_usable(const Eigen::Vector3f& point) {
  return (point.array().abs() <= kLargestMeshCoordinate).all();  // false for NaN
}

}  // namespace lamina::engine
