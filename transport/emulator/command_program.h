#pragma once

#include <array>
#include <deque>
#include <optional>
#include <string>
#include <variant>

#include "transport/emulator/emulator_options.h"
#include "transport/emulator/gcode_command.h"
#include "transport/emulator/machine.h"
#include "transport/emulator/sd_card.h"
#include "transport/protocol/line_framing.h"
#include "transport/time.h"

namespace lamina::transport {

/// Settings of the firmware that commands change and that are not the machine's.
struct HostSettings {
  Duration busy_interval{};
  Duration temperature_interval{};  ///< M155; 0 is off
  Duration position_interval{};     ///< M154; 0 is off
  Duration card_interval{};         ///< M27 S; 0 is off
  double retraction = 0;            ///< mm, M207 S
  double retraction_feedrate = 0;   ///< mm/s, M207 F
};

/// What a command acts on.
struct Firmware {
  Machine& machine;
  HostSettings& settings;
  SdCard& card;
  const EmulatorOptions& options;
  Instant now;
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
/// Waits for M108 or the answer to a prompt (M0), or for a time if there is one.
struct UserStep {
  std::optional<Duration> limit;
};
/// The extruder alone, by the firmware's own retraction.
struct RetractStep {
  double length;    ///< mm, negative to draw back
  double feedrate;  ///< mm/s
};
/// Says something, a whole line or several.
struct SayStep {
  std::string text;
};
/// Says where the machine is.
struct PositionStep {};
/// The firmware halts.
struct KillStep {};

using Step = std::variant<MoveStep, RetractStep, FinishMovesStep, DwellStep, HomedStep, HeatStep, UserStep,
                          SayStep, PositionStep, KillStep>;

struct CommandProgram {
  std::deque<Step> steps;
  bool acknowledged = true;                 ///< an ok follows; M105 says its own
  std::optional<LineNumber> new_last_line;  ///< M110
  bool request_resend = false;              ///< M999
};

/// The program of `command`. Settings take effect here and now (commands run one after the other), everything
/// that takes time or a place in the planner is a step.
CommandProgram make_program(const GcodeCommand& command, const Firmware& firmware);

/// "SD printing byte 123/456", as M27 and its automatic report say it.
std::string card_progress(const SdCard& card);

}  // namespace lamina::transport
