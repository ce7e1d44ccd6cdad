#include "transport/session/parking.h"

#include <algorithm>
#include <utility>

#include "transport/protocol/command_words.h"

namespace lamina::transport {

namespace {

constexpr double kMinute = 60;
constexpr double kInch = 25.4;

std::string feedrate(double speed) {
  return word_text('F', speed * kMinute);
}

bool stands_somewhere(const MachineState& state) {
  return state.position[0] && state.position[1] && state.position[2];
}

void retract_and_leave(const MachineState& at, const ParkOptions& options, bool hot,
                       std::vector<std::string>& commands) {
  if (at.inches) commands.emplace_back("G21");
  commands.emplace_back("G90");
  commands.emplace_back("M83");
  if (hot && options.retraction > 0)
    commands.push_back("G1" + word_text('E', -options.retraction) + feedrate(options.retract_speed));
  if (!stands_somewhere(at)) return;
  const double height = std::min(*at.position[2] + options.lift, options.highest);
  if (height > *at.position[2])
    commands.push_back("G1" + word_text('Z', height) + feedrate(options.lift_speed));
  if (options.place) {
    commands.push_back("G1" + word_text('X', (*options.place)[0]) + word_text('Y', (*options.place)[1]) +
                       feedrate(options.travel_speed));
  }
}

void restore_modes(const MachineState& to, std::vector<std::string>& commands) {
  if (to.inches) commands.emplace_back("G20");
  commands.emplace_back(to.relative ? "G91" : "G90");
  commands.emplace_back(to.extruder_relative ? "M83" : "M82");
  if (to.feedrate) commands.push_back("G1" + word_text('F', *to.feedrate / (to.inches ? kInch : 1)));
}

}  // namespace

std::vector<std::string> park_commands(const MachineState& at, const ParkOptions& options, bool hot) {
  std::vector<std::string> commands;
  retract_and_leave(at, options, hot, commands);
  commands.emplace_back("M400");
  return commands;
}

std::vector<std::string> heating_commands(const MachineState& from, const MachineState& to) {
  std::vector<std::string> commands;
  const auto nozzle = [](const MachineState& state, int tool) {
    const auto found = state.nozzles.find(tool);
    return found == state.nozzles.end() ? 0.0 : found->second;
  };
  const auto tool_word = [&](int tool) { return tool == to.tool ? "" : word_text('T', tool); };
  if (from.bed != to.bed) commands.push_back("M140" + word_text('S', to.bed));
  if (from.chamber != to.chamber) commands.push_back("M141" + word_text('S', to.chamber));
  for (const auto& [tool, wanted] : to.nozzles) {
    if (nozzle(from, tool) != wanted) commands.push_back("M104" + tool_word(tool) + word_text('S', wanted));
  }
  if (to.bed > from.bed) commands.push_back("M190" + word_text('S', to.bed));
  for (const auto& [tool, wanted] : to.nozzles) {
    if (wanted > nozzle(from, tool)) commands.push_back("M109" + tool_word(tool) + word_text('S', wanted));
  }
  return commands;
}

std::vector<std::string> return_commands(const MachineState& from, const MachineState& to,
                                         const ParkOptions& options) {
  std::vector<std::string> commands;
  if (from.tool != to.tool) commands.push_back("T" + number_text(to.tool));
  for (std::string& command : heating_commands(from, to)) commands.push_back(std::move(command));
  commands.emplace_back("G21");
  commands.emplace_back("G90");
  commands.emplace_back("M83");
  // The prime must not come out on the part: everything out here, and then drawn back as `to` has it.
  const double retracted = to.e_peak - to.e_total;
  const double drawn_back = to.e_total - from.e_total;
  const auto nozzle = to.nozzles.find(to.tool);
  const bool hot = nozzle != to.nozzles.end() && nozzle->second > 0;
  // Less, if somebody has pushed filament out in the meantime.
  const double push = std::max(0.0, drawn_back + retracted + options.prime);
  if (hot && push > 0) commands.push_back("G1" + word_text('E', push) + feedrate(options.prime_speed));
  if (hot && retracted > 0)
    commands.push_back("G1" + word_text('E', -retracted) + feedrate(options.retract_speed));
  if (stands_somewhere(to)) {
    commands.push_back("G1" + word_text('X', *to.position[0]) + word_text('Y', *to.position[1]) +
                       feedrate(options.travel_speed));
    commands.push_back("G1" + word_text('Z', *to.position[2]) + feedrate(options.lift_speed));
  }
  commands.push_back("G92" + word_text('E', to.e));
  restore_modes(to, commands);
  return commands;
}

std::vector<std::string> cancel_commands(const MachineState& at, const ParkOptions& options, bool hot) {
  std::vector<std::string> commands;
  for (const auto& [tool, wanted] : at.nozzles)
    commands.push_back("M104" + (tool == at.tool ? "" : word_text('T', tool)) + " S0");
  if (at.nozzles.empty()) commands.emplace_back("M104 S0");
  commands.emplace_back("M140 S0");
  if (at.chamber != 0) commands.emplace_back("M141 S0");
  commands.emplace_back("M107");
  retract_and_leave(at, options, hot, commands);
  commands.emplace_back("M84");
  return commands;
}

}  // namespace lamina::transport
