#include "gcode/filament_options.h"

#include <numbers>

namespace lamina::gcode {

double FilamentOptions::area() const {
  return 0.25 * std::numbers::pi * diameter * diameter;
}

}  // namespace lamina::gcode
