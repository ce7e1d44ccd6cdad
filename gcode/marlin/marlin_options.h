#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace lamina::gcode {

/// Degrees Celsius; 0 leaves a heater alone.
struct TemperatureOptions {
  double nozzle_first_layer = 215.0;
  double nozzle = 210.0;
  double nozzle_idle = 150.0;  ///< While homing and waiting for the bed: hot enough, and it does not ooze.
  double bed_first_layer = 60.0;
  double bed = 60.0;
  double chamber = 0.0;
};

/// G-code of the printer with placeholders (see template.h). Lines end with a line feed; empty = none.
struct TemplateOptions {
  std::string start;         ///< Before the first layer.
  std::string end;           ///< After the last layer.
  std::string before_layer;  ///< At each layer change, before the move to the new height.
  std::string after_layer;   ///< At each layer change, after it.
  std::string filament_start;
  std::string filament_end;
};

/// What this printer's firmware understands. All off is safe everywhere.
struct FirmwareFeatures {
  bool m73 = false;            ///< M73 progress.
  bool accelerations = false;  ///< M204 where the acceleration changes.
};

/// How toolpaths become Marlin G-code.
struct MarlinOptions {
  std::string generator = "lamina";
  std::string generator_version = "0.1.0";
  std::int64_t timestamp = 0;  ///< For the first line: seconds since 1970-01-01 00:00:00 UTC.
  std::string object_name = "part";

  std::string printer_name = "generic_marlin_220";
  std::string printer_model = "Generic Marlin 220";
  std::string printer_vendor = "Generic";
  std::string quality_name = "normal";
  double nozzle_diameter = 0.4;     ///< mm
  double layer_height = 0.2;        ///< mm, for the footer; the layers themselves say what is printed.
  double first_layer_height = 0.2;  ///< mm, for the footer.

  TemperatureOptions temperature;
  TemplateOptions templates;
  FirmwareFeatures features;
  bool label_objects = true;  ///< Comments around each layer's part that let a host cancel an object.

  int xyz_decimals = 3;
  int e_decimals = 5;
  double max_extrusion =
      200.0;  ///< Longest E word of one line, mm: Marlin drops a longer one (EXTRUDE_MAXLENGTH).

  /// Further "key = value" lines for the footer's block: the resolved profile.
  std::vector<std::pair<std::string, std::string>> config;
};

}  // namespace lamina::gcode
