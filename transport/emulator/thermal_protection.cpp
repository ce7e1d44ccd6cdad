#include "transport/emulator/thermal_protection.h"

namespace lamina::transport {

std::string ThermalProtection::look(const Heater& heater, Instant now) {
  const double temperature = heater.temperature();
  const auto watch = [&] {
    watched_from_ = temperature + options_.heating_increase;
    watch_ends_ = now + options_.heating_period;
  };
  if (heater.target() != target_) {
    target_ = heater.target();
    reached_ = false;
    low_since_.reset();
    watch();
  }
  if (target_ <= 0) return {};
  if (temperature >= target_ - options_.hysteresis) {
    // A new target that lies lower counts as reached when it has cooled down to it.
    reached_ = reached_ || temperature <= target_ + options_.hysteresis;
    low_since_.reset();
    watch();
    return {};
  }
  if (!reached_) {
    if (temperature >= watched_from_) watch();
    return now >= watch_ends_ ? "Heating failed" : "";
  }
  if (!low_since_) low_since_ = now;
  return now >= *low_since_ + options_.runaway_period ? "Thermal Runaway" : "";
}

}  // namespace lamina::transport
