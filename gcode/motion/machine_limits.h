#pragma once

namespace lamina::gcode {

/// One value for each axis; e is the extruder, in mm of filament.
struct AxisValues {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double e = 0.0;
};

/// What the firmware allows, in Marlin's terms (M201, M203, M204, M205). The defaults are those of the
/// generic 220 mm printer.
struct MachineLimits {
  AxisValues max_feedrate{200.0, 200.0, 10.0, 50.0};         ///< mm/s
  AxisValues max_acceleration{500.0, 500.0, 100.0, 1000.0};  ///< mm/s^2
  AxisValues max_jerk{8.0, 8.0, 0.3,
                      5.0};              ///< Largest sudden change of speed of an axis (classic jerk), mm/s.
  double print_acceleration = 500.0;     ///< Moves that extrude, mm/s^2
  double retract_acceleration = 1000.0;  ///< Moves of the extruder alone, mm/s^2
  double travel_acceleration = 500.0;    ///< mm/s^2
  double min_print_feedrate = 0.0;       ///< mm/s
  double min_travel_feedrate = 0.0;      ///< mm/s
};

}  // namespace lamina::gcode
