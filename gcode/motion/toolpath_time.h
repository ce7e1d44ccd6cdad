#pragma once

#include "engine/geometry/vector.h"
#include "gcode/filament_options.h"
#include "gcode/motion/look_ahead.h"
#include "gcode/motion/machine_limits.h"
#include "gcode/toolpath.h"

namespace lamina::gcode {

/// A move as the machine sees it, from `start`; the tag is left 0.
Segment segment_of(const Move& move, const engine::Vector3& start, const FilamentOptions& filament);

/// Time of one layer from standstill to standstill, s.
double layer_time(const LayerToolpath& layer, const engine::Vector3& start, const FilamentOptions& filament,
                  const MachineLimits& limits);

}  // namespace lamina::gcode
