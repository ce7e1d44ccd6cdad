#pragma once

#include "transport/emulator/emulator_options.h"
#include "transport/time.h"

namespace lamina::transport {

/// A heater with its thermal mass and controller. dT/dt = power * heating_rate - (T - room) / time_constant;
/// the controller gives full power below the band, and in it what holds the target plus a share of what is
/// missing, so the temperature arrives without overshoot and stays.
class Heater {
 public:
  Heater(const HeaterOptions& options, double room, Instant now);

  /// Follows the temperature up to `now`.
  void advance(Instant now);

  void set_target(double celsius) { target_ = celsius; }

  /// Its wire is broken from here on: the controller does what it does, and nothing gets warm.
  void break_wire() { options_.heating_rate = 0; }

  double temperature() const { return temperature_; }
  double target() const { return target_; }

  /// What M105 calls @: 0..127.
  int power() const;

 private:
  double duty() const;

  HeaterOptions options_;
  double room_;
  double temperature_;
  double target_ = 0;
  Instant time_;
};

}  // namespace lamina::transport
