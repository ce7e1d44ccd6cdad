#pragma once

namespace lamina::gcode {

/// A straight move that speeds up with constant acceleration, runs at its cruise speed if it gets that far,
/// and slows down with the same acceleration. Lengths in mm, speeds in mm/s, acceleration in mm/s^2, all
/// positive; entry and exit at most the cruise speed.
struct Trapezoid {
  double length = 0.0;
  double entry = 0.0;
  double cruise = 0.0;
  double exit = 0.0;
  double acceleration = 0.0;
};

/// How long it takes, s. Where the length does not suffice to come from entry to exit speed, the faster of
/// the two is lowered to what it does suffice for.
double duration(const Trapezoid& move);

/// The speed reached from `speed` over `length`, mm/s.
double reachable_speed(double speed, double acceleration, double length);

}  // namespace lamina::gcode
