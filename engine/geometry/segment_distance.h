#pragma once

#include <algorithm>

#include "engine/geometry/vector.h"

namespace lamina::engine {

/// Squared distance of a point from the segment from a to b, mm^2; from a where the two coincide. In the
/// plane or in space.
template <typename Vector>
double squared_distance(const Vector& point, const Vector& a, const Vector& b) {
  const Vector along = b - a;
  const double length = along.squaredNorm();
  const double t = length > 0.0 ? std::clamp((point - a).dot(along) / length, 0.0, 1.0) : 0.0;
  return (point - a - t * along).squaredNorm();
}

}  // namespace lamina::engine
