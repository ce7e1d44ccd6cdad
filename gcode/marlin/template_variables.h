#pragma once

#include "gcode/gcode_options.h"
#include "gcode/marlin/expression.h"
#include "gcode/print_outline.h"
#include "gcode/toolpath.h"

namespace lamina::gcode {

/// Names that every template knows: first_layer_nozzle, nozzle, idle_nozzle, first_layer_bed, bed, chamber;
/// bed_x, bed_y, bed_z (size of the volume, mm); print_min_x ... print_max_z (the placed model, mm), max_z,
/// layers; layer_height, first_layer_height, nozzle_diameter, filament_diameter, filament_type, travel_speed
/// (mm/s).
TemplateVariables print_variables(const GcodeOptions& options, const PrintOutline& outline);

/// Those and layer (0-based) and layer_z, for the templates at a layer change.
TemplateVariables layer_variables(TemplateVariables print, const LayerToolpath& layer);

}  // namespace lamina::gcode
