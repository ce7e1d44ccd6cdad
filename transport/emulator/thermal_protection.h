#pragma once

#include <optional>
#include <string>

#include "transport/emulator/emulator_options.h"
#include "transport/emulator/heater.h"
#include "transport/time.h"

namespace lamina::transport {

/// Marlin's watch over one heater: while it heats up, it must get warmer by some degrees in some seconds;
/// once it has been at its target, it must not fall below it for long.
class ThermalProtection {
 public:
  explicit ThermalProtection(const ProtectionOptions& options) : options_(options) {}

  /// Looks at the heater, about once a second. What has gone wrong, in Marlin's words ("Heating failed",
  /// "Thermal Runaway"); empty while all is well.
  std::string look(const Heater& heater, Instant now);

 private:
  ProtectionOptions options_;
  double target_ = 0;
  bool reached_ = false;
  double watched_from_ = 0;  ///< deg C to be reached
  Instant watch_ends_{};
  std::optional<Instant> low_since_;
};

}  // namespace lamina::transport
