#pragma once

#include <cstddef>
#include <vector>

#include "engine/geometry/vector.h"

namespace lamina::gcode {

/// What a print adds up to.
struct PrintTotals {
  std::size_t layers = 0;
  double volume = 0.0;                ///< Planned volume of all beads, mm^3.
  double filament_length = 0.0;       ///< Drawn off the spool, that of the start G-code included, mm.
  double max_z = 0.0;                 ///< Of the beads, mm.
  engine::Box3 bounds;                ///< Around the beads, skirt included, mm.
  std::vector<double> layer_seconds;  ///< Estimated time of each layer.
  double seconds = 0.0;  ///< Estimated time of everything that moves; heating and homing are not in it.

  double narrow_area = 0.0;       ///< Parts of regions too narrow for a wall, where nothing was laid, mm^2.
  std::size_t open_contours = 0;  ///< Contours that bound no area and were left out.
  std::size_t touch_contours = 0;
  std::size_t touch_points = 0;
  std::size_t crossing_contours = 0;  ///< Pairs of contours that cross: solids that overlap.
};

}  // namespace lamina::gcode
