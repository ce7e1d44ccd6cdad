#include "gcode/plan/bead.h"

#include <numbers>

namespace lamina::gcode {
namespace {

constexpr double kQuarterPi = std::numbers::pi / 4.0;

}  // namespace

double bead_area(double width, double height) {
  return height * bead_spacing(width, height);
}

double bead_spacing(double width, double height) {
  return width - height * (1.0 - kQuarterPi);
}

double bead_width(double spacing, double height) {
  return spacing + height * (1.0 - kQuarterPi);
}

}  // namespace lamina::gcode
