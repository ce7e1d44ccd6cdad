#pragma once

#include "engine/geometry/polygon.h"
#include "gcode/toolpath.h"

namespace lamina::gcode {

/// The centre line of one bead of constant width, laid without lifting the nozzle.
struct BeadPath {
  Role role = Role::kOuterWall;
  double width = 0.45;      ///< mm
  bool closed = false;      ///< From the last point back to the first.
  engine::Polyline points;  ///< mm
};

}  // namespace lamina::gcode
