#pragma once

#include <cstddef>

#include "engine/geometry/vector.h"

namespace lamina::gcode {

/// What is known of a print before its first layer is sliced.
struct PrintOutline {
  engine::Box3 bounds;     ///< Around the placed model, printer coordinates, mm.
  std::size_t layers = 0;  ///< How many will come.
};

}  // namespace lamina::gcode
