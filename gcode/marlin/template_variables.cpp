#include "gcode/marlin/template_variables.h"

#include <string>
#include <utility>

namespace lamina::gcode {

TemplateVariables print_variables(const GcodeOptions& options, const PrintOutline& outline) {
  const TemperatureOptions& temperature = options.marlin.temperature;
  const engine::Box3 room = options.volume.bounds();
  const engine::Vector3 size = room.sizes();
  TemplateVariables variables{
      {"first_layer_nozzle", temperature.nozzle_first_layer},
      {"nozzle", temperature.nozzle},
      {"idle_nozzle", temperature.nozzle_idle},
      {"first_layer_bed", temperature.bed_first_layer},
      {"bed", temperature.bed},
      {"chamber", temperature.chamber},
      {"bed_x", size.x()},
      {"bed_y", size.y()},
      {"bed_z", size.z()},
      {"layers", static_cast<double>(outline.layers)},
      {"layer_height", options.marlin.layer_height},
      {"first_layer_height", options.marlin.first_layer_height},
      {"nozzle_diameter", options.marlin.nozzle_diameter},
      {"filament_diameter", options.filament.diameter},
      {"filament_type", options.filament.type},
      {"travel_speed", options.plan.speed.travel},
  };
  if (!outline.bounds.isEmpty()) {
    const engine::Vector3 low = outline.bounds.min();
    const engine::Vector3 high = outline.bounds.max();
    for (const auto& [name, axis] : {std::pair{"x", 0}, {"y", 1}, {"z", 2}}) {
      variables[std::string("print_min_") + name] = low[axis];
      variables[std::string("print_max_") + name] = high[axis];
    }
    variables["max_z"] = high.z();
  }
  return variables;
}

TemplateVariables layer_variables(TemplateVariables print, const LayerToolpath& layer) {
  print["layer"] = static_cast<double>(layer.index);
  print["layer_z"] = layer.z;
  return print;
}

}  // namespace lamina::gcode
