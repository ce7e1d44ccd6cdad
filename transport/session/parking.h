#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "transport/session/machine_state.h"
#include "transport/time.h"

namespace lamina::transport {

struct ParkOptions {
  /// Where the nozzle waits: X, Y in mm. None: above the place where it stopped.
  std::optional<std::array<double, 2>> place;
  double lift = 10;       ///< mm that the nozzle is raised before it leaves the part
  double highest = 1e9;   ///< mm; no lift goes above
  double retraction = 2;  ///< mm of filament drawn back before the lift
  double prime = 2;       ///< mm of filament pushed out at the parking place before it goes back, beyond what
                          ///< was drawn back
  double prime_cold = 10;     ///< the same after a restart: what has oozed out while nobody held the pressure
  double retract_speed = 30;  ///< mm/s
  double prime_speed = 5;     ///< mm/s
  double travel_speed = 100;  ///< mm/s
  double lift_speed = 10;     ///< mm/s
  /// How long a parked nozzle and bed stay hot. The bed longer: parts come off a cold one.
  Duration keep_nozzle_hot = std::chrono::minutes(10);
  Duration keep_bed_hot = std::chrono::hours(2);
};

/// Draws the filament back, lifts and goes to the parking place, from `at`; ends when it is there. Axes that
/// were not homed are not moved, filament only if `hot`.
std::vector<std::string> park_commands(const MachineState& at, const ParkOptions& options, bool hot);

/// From a parked printer (`from`) back to `to`: heaters first, each waited for if it is to be hotter, then
/// filament pushed out at the parking place (what was drawn back since `to`, and the prime), across, down,
/// and every mode as it was.
std::vector<std::string> return_commands(const MachineState& from, const MachineState& to,
                                         const ParkOptions& options);

/// The targets of `to` where they differ from those of `from`: all set first, then waited for where the
/// printer has to heat up.
std::vector<std::string> heating_commands(const MachineState& from, const MachineState& to);

/// Heaters and fans off, then away from the part, motors off. Filament is drawn back only if `hot`.
std::vector<std::string> cancel_commands(const MachineState& at, const ParkOptions& options, bool hot);

}  // namespace lamina::transport
