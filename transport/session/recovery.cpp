#include "transport/session/recovery.h"

#include <algorithm>
#include <utility>

#include "transport/protocol/command_class.h"
#include "transport/protocol/command_words.h"

namespace lamina::transport {

MachineState recovery_goal(const JournalRecord& record) {
  const bool lines_open = std::any_of(record.lines.begin(), record.lines.end(), [](const JournalLine& line) {
    return line.origin == LineOrigin::kJob;
  });
  if (record.parked_from && !lines_open) return *record.parked_from;
  // Commands of the host in front of the first open line lead to where that line begins. Those between lines
  // come back to where they began (a pause) or change a setting.
  MachineState goal = record.printer;
  bool line_seen = false;
  for (const JournalLine& line : record.lines) {
    line_seen = line_seen || line.origin == LineOrigin::kJob;
    if (line.origin == LineOrigin::kJob || (line_seen && places(line.command))) continue;
    goal = after(std::move(goal), line.command);
  }
  return goal;
}

std::optional<double> lowest_height(const JournalRecord& record) {
  MachineState state = record.printer;
  std::optional<double> lowest = state.position[2];
  for (const JournalLine& line : record.lines) {
    state = after(std::move(state), line.command);
    if (lowest && state.position[2]) lowest = std::min(*lowest, *state.position[2]);
  }
  return lowest;
}

std::vector<std::string> recover_commands(const MachineState& from, const MachineState& to,
                                          const ParkOptions& options) {
  MachineState state = from;
  std::vector<std::string> commands;
  const auto add = [&](const std::string& command) {
    commands.push_back(command);
    state = after(std::move(state), command);
  };
  if (to.tool != from.tool) add("T" + number_text(to.tool));
  for (const std::string& command : heating_commands(state, to)) add(command);
  add("G21");
  add("G90");
  add("G92" + word_text('Z', *from.position[2]));
  const double height = std::min(*to.position[2] + options.lift, options.highest);
  constexpr double kMinute = 60;
  if (height > *from.position[2])
    add("G1" + word_text('Z', height) + word_text('F', options.lift_speed * kMinute));
  add("M400");
  add("G28 X Y");
  for (const std::string& command : settings_commands(to)) add(command);
  ParkOptions cold = options;
  cold.prime = options.prime_cold;
  for (const std::string& command : return_commands(state, to, cold)) commands.push_back(command);
  return commands;
}

std::optional<std::string> unrecoverable(const MachineState& goal) {
  if (!goal.position[0] || !goal.position[1] || !goal.position[2])
    return "the place where it stood is not known";
  const auto nozzle = goal.nozzles.find(goal.tool);
  if (nozzle == goal.nozzles.end() || nozzle->second <= 0) return "the nozzle was not heated yet";
  return std::nullopt;
}

}  // namespace lamina::transport
