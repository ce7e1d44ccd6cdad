// G codes, and the M codes that move or say how to.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "transport/emulator/curve_segments.h"
#include "transport/emulator/program_maker.h"

namespace lamina::transport {

namespace {

/// Besides an arc, in one command.
constexpr int kMostCircles = 100;

}  // namespace

bool ProgramMaker::g_code() {
  switch (command_.code) {
    case 0:
    case 1:
      add(MoveStep{machine_.destination(command_), machine_.feedrate()});
      return true;
    case 2:
    case 3:
      if (options_.features.arcs) arc();
      return options_.features.arcs;
    case 4:
      add(FinishMovesStep{});
      add(DwellStep{from_seconds(command_.has('S') ? value('S', 0) : value('P', 0) / 1000)});
      return true;
    case 5:
      if (options_.features.bezier) bezier();
      return options_.features.bezier;
    case 10:
    case 11:
      if (options_.features.firmware_retraction) retract(command_.code == 10);
      return options_.features.firmware_retraction;
    case 20:
    case 21:
      machine_.set_inches(command_.code == 20);
      return true;
    case 27:
      if (options_.features.filament_change) park();
      return options_.features.filament_change;
    case 28:
      home();
      return true;
    case 29:
      if (options_.features.leveling) level();
      return options_.features.leveling;
    case 90:
    case 91:
      machine_.set_relative(command_.code == 91);
      return true;
    case 92:
      machine_.name_position(command_);
      add(PositionStep{});
      return true;
    default:
      return false;
  }
}

void ProgramMaker::arc() {
  const MachinePosition start = machine_.planned();
  const MachinePosition end = machine_.destination(command_);
  const bool clockwise = command_.code == 2;
  const double unit = machine_.unit();
  const auto length = [&](char parameter) -> std::optional<double> {
    const std::optional<double> given = command_.value(parameter);
    return given ? std::optional(*given * unit) : std::nullopt;
  };
  const std::optional<double> radius = length('R');
  const int circles = command_.integer('P').value_or(0);
  std::optional<Arc> arc;
  if (radius) {
    arc = arc_by_radius(start, end, *radius, clockwise);
  } else if (circles >= 0 && circles <= kMostCircles) {
    arc = arc_by_center(start, length('I'), length('J'), clockwise, circles);
  }
  if (!arc) {
    say("Error:G2/G3 bad parameters\n");
    return;
  }
  follow(arc_segments(start, end, *arc));
}

void ProgramMaker::bezier() {
  const MachinePosition start = machine_.planned();
  const MachinePosition end = machine_.destination(command_);
  const double unit = machine_.unit();
  follow(bezier_segments(start, start[0] + value('I', 0) * unit, start[1] + value('J', 0) * unit,
                         end[0] + value('P', 0) * unit, end[1] + value('Q', 0) * unit, end));
}

void ProgramMaker::follow(const std::vector<MachinePosition>& points) {
  for (const MachinePosition& point : points) add(MoveStep{point, machine_.feedrate()});
}

void ProgramMaker::home() {
  std::array<bool, 3> axes{command_.has('X'), command_.has('Y'), command_.has('Z')};
  if (!axes[0] && !axes[1] && !axes[2]) axes = {true, true, true};
  add(FinishMovesStep{});
  add(DwellStep{machine_.homing_time(axes)});
  add(HomedStep{axes});
  add(PositionStep{});
}

/// G10 and G11. The second of the same kind changes nothing.
void ProgramMaker::retract(bool back) {
  if (machine_.retracted() == back) return;
  machine_.set_retracted(back);
  add(RetractStep{back ? -settings_.retraction : settings_.retraction, settings_.retraction_feedrate});
}

void ProgramMaker::park() {
  const MotionOptions& motion = options_.motion;
  MachinePosition place = machine_.planned();
  place[2] = std::min(place[2] + motion.park[2], motion.bed_max[2]);
  add(FinishMovesStep{});
  add(MoveStep{place, motion.homing_feedrate[2]});
  place[0] = motion.park[0];
  place[1] = motion.park[1];
  add(MoveStep{place, motion.homing_feedrate[0]});
  add(FinishMovesStep{});
}

/// G29 with a probe that finds an even bed.
void ProgramMaker::level() {
  constexpr int kPoints = 3;
  add(FinishMovesStep{});
  add(DwellStep{std::chrono::seconds(2) * kPoints * kPoints});
  std::string grid = "Bilinear Leveling Grid:\n     0       1       2\n";
  for (int row = 0; row < kPoints; ++row) grid += fmt::format(" {} +0.000  +0.000  +0.000\n", row);
  say(grid + "\n");
  add(PositionStep{});
}

bool ProgramMaker::motion_code() {
  switch (command_.code) {
    case 17:
      return true;
    case 18:
    case 84:
    case 400:
      add(FinishMovesStep{});
      return true;
    case 82:
    case 83:
      machine_.set_extruder_relative(command_.code == 83);
      return true;
    case 211:
      if (command_.has('S')) machine_.set_soft_limits(value('S', 1) != 0);
      say(fmt::format("Soft endstops: {}\n", value('S', 1) != 0 ? "On" : "Off"));
      return true;
    case 220:
      if (command_.has('S')) {
        machine_.set_feed_percent(std::clamp(value('S', 100), 1.0, 999.0));
      } else {
        say(fmt::format("FR:{:.0f}%\n", machine_.feed_percent()));
      }
      return true;
    case 221:
      if (command_.has('S')) {
        machine_.set_flow_percent(std::clamp(value('S', 100), 1.0, 999.0));
      } else {
        say(fmt::format("echo:E0 Flow: {:.0f}%\n", machine_.flow_percent()));
      }
      return true;
    default:
      return false;
  }
}

/// What the planner and the retraction keep to.
bool ProgramMaker::limit_code() {
  MotionOptions& limits = machine_.planner().limits();
  const auto per_axis = [this](PerAxis& values) {
    constexpr std::array<char, 4> kAxes{'X', 'Y', 'Z', 'E'};
    for (std::size_t axis = 0; axis < 4; ++axis) {
      if (const auto given = command_.value(kAxes[axis]); given && *given > 0)
        values[axis] = *given * machine_.unit();
    }
  };
  switch (command_.code) {
    case 201:
      per_axis(limits.max_acceleration);
      return true;
    case 203:
      per_axis(limits.max_feedrate);
      return true;
    case 204:
      if (command_.has('S')) limits.acceleration = limits.travel_acceleration = std::max(1.0, value('S', 1));
      limits.acceleration = std::max(1.0, value('P', limits.acceleration));
      limits.retract_acceleration = std::max(1.0, value('R', limits.retract_acceleration));
      limits.travel_acceleration = std::max(1.0, value('T', limits.travel_acceleration));
      return true;
    case 205:
      if (limits.jerk) per_axis(*limits.jerk);
      if (command_.has('J'))
        limits.junction_deviation = std::max(0.001, value('J', limits.junction_deviation));
      return true;
    case 207:
      if (!options_.features.firmware_retraction) return false;
      settings_.retraction = value('S', settings_.retraction);
      if (command_.has('F')) settings_.retraction_feedrate = value('F', 1) / 60;
      return true;
    default:
      return false;
  }
}

}  // namespace lamina::transport
