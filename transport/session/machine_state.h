#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "transport/protocol/reply.h"

namespace lamina::transport {

/// What a printer remembers of the commands it has run: where it is and how it will take the next line. A
/// plain value; `after` gives the state behind one more command. Lengths in mm, whatever unit the commands
/// had.
struct MachineState {
  /// X, Y, Z in the coordinates that the commands use (G92 included). None: nobody knows, as before homing.
  std::array<std::optional<double>, 3> position;
  double e = 0;        ///< the extruder's coordinate
  double e_total = 0;  ///< filament fed since the beginning, retractions counted back; G92 does not change it
  double e_peak = 0;   ///< the most that e_total has been; what it is below that is retracted
  bool relative = false;           ///< G91
  bool extruder_relative = false;  ///< M83, or G91 since
  bool inches = false;             ///< G20
  std::array<bool, 3> homed{};
  std::optional<double> feedrate;  ///< mm/min, as the last F said
  double feed_percent = 100;       ///< M220
  double flow_percent = 100;       ///< M221
  int tool = 0;
  std::map<int, double> nozzles;  ///< deg C wanted, by tool
  double bed = 0;
  double chamber = 0;
  std::map<int, int> fans;  ///< 0..255, by number
  /// Settings that a restart resets to the stored ones: accelerations, jerk, pressure advance and their like.
  /// Code to its parameters, by letter.
  std::map<std::string, std::map<char, double>> settings;

  bool operator==(const MachineState&) const = default;
};

/// The state after `command` (stripped) has run.
MachineState after(MachineState state, std::string_view command);

/// The state with the targets that the printer itself reports, where it does.
MachineState with_targets(MachineState state, const TemperatureReport& report);

/// Commands that set the fans as in `state`.
std::vector<std::string> fan_commands(const MachineState& state);

/// Whether the acknowledgement of `command` means that every earlier move has ended.
bool waits_for_moves(std::string_view command);

/// Whether `command` moves the axes or changes what the words of the next move mean.
bool places(std::string_view command);

/// Commands that bring a freshly started printer to the targets and settings of `state`, positions and waits
/// for heaters apart.
std::vector<std::string> settings_commands(const MachineState& state);

}  // namespace lamina::transport
