#pragma once

#include <string>

namespace lamina::gcode {

/// What is on the spool.
struct FilamentOptions {
  std::string name = "generic";  ///< The profile's name, for the footer.
  std::string type = "PLA";      ///< Material class: PLA, PETG, ABS, TPU, ...
  std::string vendor = "Generic";
  std::string color = "#808080";  ///< #RRGGBB
  double diameter = 1.75;         ///< mm
  double density = 1.24;          ///< g/cm^3
  double cost = 25.0;             ///< Price of one kilogram.
  double flow = 1.0;              ///< Filament fed per planned volume; 1 feeds exactly the planned volume.
  double max_volumetric_speed = 15.0;  ///< What the hot end melts, mm^3/s; 0 = no limit.

  /// Cross-section of the filament, mm^2.
  double area() const;
};

}  // namespace lamina::gcode
