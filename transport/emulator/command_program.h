#pragma once

#include <array>
#include <deque>
#include <optional>
#include <string>
#include <variant>

#include "transport/emulator/emulator_options.h"
#include "transport/emulator/gcode_command.h"
#include "transport/emulator/machine.h"
#include "transport/protocol/line_framing.h"
#include "transport/time.h"

namespace lamina::transport {

/// Settings of the firmware that commands change and that are not the machine's.
struct HostSettings {
  Duration busy_interval{};
  Duration temperature_interval{};  ///< M155; 0 is off
  Duration position_interval{};     ///< M154; 0 is off
};

// What a command does, step by step. Each step is over at once or waits for something.

/// A straight move; waits for a free place in the planner.
struct MoveStep {
  MachinePosition target;
  double feedrate;  ///< mm/s
};
/// Waits until every move has been run.
struct FinishMovesStep {};
/// Waits for a time.
struct DwellStep {
  Duration time;
};
/// The axes have found their end stops.
struct HomedStep {
  std::array<bool, 3> axes;
};
enum class HeaterName { kHotend, kBed };
/// Waits until the heater has held its target.
struct HeatStep {
  HeaterName heater;
  bool also_cool;  ///< wait for cooling, too
};
/// Waits for M108 (M0), or for a time if there is one.
struct UserStep {
  std::optional<Duration> limit;
};
/// Says something, a whole line or several.
struct SayStep {
  std::string text;
};
/// Says where the machine is.
struct PositionStep {};
/// The firmware halts.
struct KillStep {};

using Step = std::variant<MoveStep, FinishMovesStep, DwellStep, HomedStep, HeatStep, UserStep, SayStep,
                          PositionStep, KillStep>;

struct CommandProgram {
  std::deque<Step> steps;
  bool acknowledged = true;                 ///< an ok follows; M105 says its own
  std::optional<LineNumber> new_last_line;  ///< M110
  bool request_resend = false;              ///< M999
};

/// The program of `command`. Settings take effect here and now (commands run one after the other), everything
/// that takes time or a place in the planner is a step.
CommandProgram make_program(const GcodeCommand& command, Machine& machine, HostSettings& settings,
                            const EmulatorOptions& options, Instant now);

}  // namespace lamina::transport
