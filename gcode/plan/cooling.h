#pragma once

#include "engine/geometry/vector.h"
#include "gcode/filament_options.h"
#include "gcode/motion/machine_limits.h"
#include "gcode/plan/cooling_options.h"
#include "gcode/toolpath.h"

namespace lamina::gcode {

/// Gives a layer the time and the air it needs: slows its extruding moves down by one common factor, none of
/// them below options.min_speed, until it takes options.slow_below_time (within 1 %, or as far as that goes),
/// and sets the fan from the time it takes then.
LayerToolpath cooled(LayerToolpath layer, const engine::Vector3& start, const CoolingOptions& options,
                     const FilamentOptions& filament, const MachineLimits& limits);

/// Power of the fan, in [0, 1], for a layer that takes so long.
double fan_power(std::size_t layer, double seconds, const CoolingOptions& options);

}  // namespace lamina::gcode
