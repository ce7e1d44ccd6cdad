#include "transport/emulator/heater.h"

#include <algorithm>
#include <cmath>

namespace lamina::transport {

namespace {

/// The controller looks at the temperature as often as Marlin's does.
constexpr Duration kControlPeriod = std::chrono::milliseconds(100);

}  // namespace

Heater::Heater(const HeaterOptions& options, double room, Instant now)
    : options_(options), room_(room), temperature_(room), time_(now) {}

void Heater::advance(Instant now) {
  // Between two looks of the controller the power is constant and the temperature an exponential, which is
  // exact however often this is called; the looks themselves come at fixed times, so a result does not depend
  // on the calls.
  while (time_ + kControlPeriod <= now) {
    if (target_ <= 0 && temperature_ == room_) {
      time_ += (now - time_) / kControlPeriod * kControlPeriod;
      return;
    }
    const double settles_at = room_ + duty() * options_.heating_rate * options_.time_constant;
    const double fading = std::exp(-to_seconds(kControlPeriod) / options_.time_constant);
    temperature_ = settles_at + (temperature_ - settles_at) * fading;
    if (std::abs(temperature_ - room_) < 1e-6 && target_ <= 0) temperature_ = room_;
    time_ += kControlPeriod;
  }
}

double Heater::duty() const {
  if (target_ <= 0) return 0;
  if (options_.heating_rate <= 0) return 1;
  const double holding = (target_ - room_) / (options_.heating_rate * options_.time_constant);
  return std::clamp(holding + (target_ - temperature_) / options_.band, 0.0, 1.0);
}

int Heater::power() const {
  return static_cast<int>(std::lround(duty() * 127));
}

}  // namespace lamina::transport
