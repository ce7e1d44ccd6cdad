#pragma once

#include <cstddef>
#include <vector>

#include "engine/geometry/polygon.h"
#include "gcode/plan/bead_path.h"
#include "gcode/plan/plan_options.h"

namespace lamina::gcode {

/// Lines that fill an area completely: length * area of the bead is area * height. The lines' spacing is
/// fitted to the extent of each polygon across them, and their width to the spacing, so that no gap is left
/// at the last one. Lines lie half a spacing inside the area. `angle` in degrees from the x axis.
std::vector<BeadPath> fill_solid(const engine::Region& area, Role role, double width, double height,
                                 double angle);

/// Lines with the chosen share of the area: their spacing is that of solid lines divided by the density,
/// counted from the origin so that lines of equal direction lie on top of each other. Ways along the boundary
/// up to options.anchor_max join them and come on top of the density.
std::vector<BeadPath> fill_sparse(const engine::Region& area, const InfillOptions& options, double width,
                                  double height, std::size_t layer);

/// Direction of the lines on a layer, degrees from the x axis: turned by 90 degrees on every second one.
double infill_angle(const InfillOptions& options, std::size_t layer);

}  // namespace lamina::gcode
