#pragma once

#include <vector>

#include "engine/geometry/polygon.h"
#include "gcode/plan/bead_path.h"
#include "gcode/plan/plan_options.h"
#include "gcode/plan/skins.h"

namespace lamina::gcode {

/// What is laid in one connected part of a layer: groups that follow each other, each free in its own order.
struct Island {
  std::vector<std::vector<BeadPath>> groups;
  double narrow_area = 0.0;  ///< mm^2 too narrow for a wall; nothing is laid there.
};

/// Where a layer stands in the part.
struct LayerPlace {
  std::size_t index = 0;
  double thickness = 0.2;  ///< mm
};

/// Walls, skins and infill of one polygon of a layer's region.
Island make_island(const engine::Polygon& polygon, const Neighbours& neighbours, const LayerPlace& place,
                   const PlanOptions& options);

}  // namespace lamina::gcode
