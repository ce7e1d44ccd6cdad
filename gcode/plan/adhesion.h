#pragma once

#include <vector>

#include "engine/geometry/polygon.h"
#include "gcode/plan/bead_path.h"
#include "gcode/plan/plan_options.h"

namespace lamina::gcode {

/// Corners of the smallest convex area around the region, counter-clockwise, none on a side (Andrew's
/// monotone chain, 1979).
engine::Loop convex_hull(const engine::Region& region);

/// Loops around the convex hull of the first layer, the outermost first: options.skirt_loops of them and more
/// until they hold `min_volume` mm^3. Empty for an empty region.
std::vector<BeadPath> make_skirt(const engine::Region& first_layer, const AdhesionOptions& options,
                                 double width, double height, double min_volume);

/// Loops around the outlines of the first layer, holes left open, the outermost first.
std::vector<BeadPath> make_brim(const engine::Region& first_layer, const AdhesionOptions& options,
                                double width, double height);

}  // namespace lamina::gcode
