#pragma once

#include "engine/geometry/vector.h"

namespace lamina::engine {

/// z component of the cross product: positive where b lies on the left of a.
inline double cross(const Vector2& a, const Vector2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace lamina::engine
