#include "transport/emulator/trapezoid.h"

#include <algorithm>
#include <cmath>

namespace lamina::transport {

double Trapezoid::cruising_time() const {
  const double way = distance - accelerating_distance() - decelerating_distance();
  return way > 0 && cruise_speed > 0 ? way / cruise_speed : 0;
}

double Trapezoid::distance_at(double time) const {
  if (time <= 0) return 0;
  const double accelerating = accelerating_time();
  if (time < accelerating) return entry_speed * time + acceleration * time * time / 2;
  const double cruising = cruising_time();
  if (time < accelerating + cruising) return accelerating_distance() + cruise_speed * (time - accelerating);
  const double left = duration() - time;
  if (left <= 0) return distance;
  return distance - exit_speed * left - acceleration * left * left / 2;
}

Trapezoid make_trapezoid(double distance, double entry_speed, double speed, double exit_speed,
                         double acceleration) {
  Trapezoid move{distance, std::min(entry_speed, speed), speed, std::min(exit_speed, speed), acceleration};
  const double gain = 2 * acceleration * distance;
  move.exit_speed = std::min(move.exit_speed, std::sqrt(move.entry_speed * move.entry_speed + gain));
  move.entry_speed = std::min(move.entry_speed, std::sqrt(move.exit_speed * move.exit_speed + gain));
  const double peak_squared =
      (gain + move.entry_speed * move.entry_speed + move.exit_speed * move.exit_speed) / 2;
  move.cruise_speed = std::min(speed, std::sqrt(peak_squared));
  // Rounding must not put the top below an end.
  move.cruise_speed = std::max({move.cruise_speed, move.entry_speed, move.exit_speed});
  return move;
}

}  // namespace lamina::transport
