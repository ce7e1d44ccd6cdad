#pragma once

#include "gcode/filament_options.h"
#include "gcode/marlin/marlin_options.h"
#include "gcode/motion/machine_limits.h"
#include "gcode/plan/cooling_options.h"
#include "gcode/plan/plan_options.h"
#include "gcode/print_volume.h"
#include "gcode/region/region_options.h"

namespace lamina::gcode {

/// Everything that the way from contours to G-code can be told; each stage reads its own part.
struct GcodeOptions {
  RegionOptions region;
  PlanOptions plan;
  CoolingOptions cooling;
  FilamentOptions filament;
  MachineLimits limits;
  PrintVolume volume;
  MarlinOptions marlin;
};

}  // namespace lamina::gcode
