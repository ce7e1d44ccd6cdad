#pragma once

#include "engine/slice_options.h"
#include "gcode/gcode_options.h"
#include "transport/port/port_options.h"

namespace lamina::profiles {

/// The option structs of every stage, as one value. A fresh one holds the built-in defaults.
struct Settings {
  engine::SlicingPlanesOptions planes;
  engine::SliceOptions slice;
  gcode::GcodeOptions gcode;
  transport::PortOptions port;
};

}  // namespace lamina::profiles
