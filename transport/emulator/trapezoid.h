#pragma once

namespace lamina::transport {

/// A move along a straight line that accelerates, cruises and decelerates at one rate. Lengths in mm, speeds
/// in mm/s, accelerations in mm/s^2, times in s from the start of the move.
struct Trapezoid {
  double distance = 0;
  double entry_speed = 0;
  double cruise_speed = 0;  ///< reached at the top; below the asked-for speed where the way is too short
  double exit_speed = 0;
  double acceleration = 1;

  double accelerating_time() const { return (cruise_speed - entry_speed) / acceleration; }
  double accelerating_distance() const {
    return (cruise_speed * cruise_speed - entry_speed * entry_speed) / (2 * acceleration);
  }
  double decelerating_time() const { return (cruise_speed - exit_speed) / acceleration; }
  double decelerating_distance() const {
    return (cruise_speed * cruise_speed - exit_speed * exit_speed) / (2 * acceleration);
  }
  double cruising_time() const;

  double duration() const { return accelerating_time() + cruising_time() + decelerating_time(); }

  /// Way covered after `time`, 0..distance.
  double distance_at(double time) const;
};

/// The trapezoid over `distance` that keeps to `speed` and `acceleration`. An entry or exit speed that the
/// distance does not allow is brought down to what it does.
Trapezoid make_trapezoid(double distance, double entry_speed, double speed, double exit_speed,
                         double acceleration);

}  // namespace lamina::transport
