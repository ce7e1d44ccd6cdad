#include "gcode/motion/trapezoid.h"

#include <algorithm>
#include <cmath>

namespace lamina::gcode {

double reachable_speed(double speed, double acceleration, double length) {
  return std::sqrt(speed * speed + 2.0 * acceleration * length);
}

double duration(const Trapezoid& move) {
  if (move.length <= 0.0) return 0.0;
  const double entry = std::min(move.entry, reachable_speed(move.exit, move.acceleration, move.length));
  const double exit = std::min(move.exit, reachable_speed(move.entry, move.acceleration, move.length));
  // v^2 = entry^2 + 2 a s going up and exit^2 + 2 a (length - s) going down meet at the peak.
  const double peak =
      std::min(move.cruise, std::sqrt(0.5 * (entry * entry + exit * exit) + move.acceleration * move.length));
  const double up = std::max(0.0, (peak * peak - entry * entry) / (2.0 * move.acceleration));
  const double down = std::max(0.0, (peak * peak - exit * exit) / (2.0 * move.acceleration));
  const double level = std::max(0.0, move.length - up - down);
  return (2.0 * peak - entry - exit) / move.acceleration + level / peak;
}

}  // namespace lamina::gcode
