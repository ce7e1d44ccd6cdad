#include "transport/session/machine_state.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "transport/protocol/command_class.h"
#include "transport/protocol/command_words.h"

namespace lamina::transport {

namespace {

constexpr double kInch = 25.4;
constexpr std::array<char, 3> kAxes{'X', 'Y', 'Z'};

bool is_move(std::string_view code) {
  return code == "G0" || code == "G1" || code == "G2" || code == "G3" || code == "G5";
}

double unit(const MachineState& state) {
  return state.inches ? kInch : 1;
}

void move(MachineState& state, const CommandWords& words) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto value = words.number(kAxes[axis]);
    if (!value) continue;
    const double length = *value * unit(state);
    if (!state.relative) {
      state.position[axis] = length;
    } else if (state.position[axis]) {
      *state.position[axis] += length;
    }
  }
  if (const auto value = words.number('E')) {
    const double length = *value * unit(state);
    const double fed = state.extruder_relative ? length : length - state.e;
    state.e += fed;
    state.e_total += fed;
    state.e_peak = std::max(state.e_peak, state.e_total);
  }
  if (const auto feedrate = words.number('F'); feedrate && *feedrate > 0)
    state.feedrate = *feedrate * unit(state);
}

void name_position(MachineState& state, const CommandWords& words) {
  const bool bare = !words.has('X') && !words.has('Y') && !words.has('Z') && !words.has('E');
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (bare) state.position[axis] = 0;
    if (const auto value = words.number(kAxes[axis])) state.position[axis] = *value * unit(state);
  }
  if (bare) state.e = 0;
  if (const auto value = words.number('E')) state.e = *value * unit(state);
}

void home(MachineState& state, const CommandWords& words) {
  const bool all = !words.has('X') && !words.has('Y') && !words.has('Z');
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!all && !words.has(kAxes[axis])) continue;
    state.homed[axis] = true;
    state.position[axis].reset();  // where that is the firmware knows, and the next move tells
  }
}

void heat(MachineState& state, const CommandWords& words) {
  const auto wanted = words.number('S') ? words.number('S') : words.number('R');
  if (!wanted) return;
  const std::string_view code = words.code();
  if (code == "M104" || code == "M109") {
    state.nozzles[static_cast<int>(words.number('T').value_or(state.tool))] = *wanted;
  } else if (code == "M140" || code == "M190") {
    state.bed = *wanted;
  } else {
    state.chamber = *wanted;
  }
}

/// Kept by letter, so that M204 P and M204 T add up.
void keep_setting(MachineState& state, const CommandWords& words) {
  std::map<char, double>& values = state.settings[std::string(words.code())];
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    if (const auto value = words.number(letter)) values[letter] = *value;
  }
}

bool is_setting(std::string_view code) {
  constexpr std::array<std::string_view, 13> kSettings{"M92",  "M200", "M201", "M203", "M204", "M205", "M207",
                                                       "M208", "M209", "M211", "M302", "M593", "M900"};
  return std::find(kSettings.begin(), kSettings.end(), code) != kSettings.end();
}

bool is_heating(std::string_view code) {
  constexpr std::array<std::string_view, 6> kHeating{"M104", "M109", "M140", "M190", "M141", "M191"};
  return std::find(kHeating.begin(), kHeating.end(), code) != kHeating.end();
}

/// Commands that leave the axes where only the firmware knows.
bool loses_position(std::string_view code) {
  constexpr std::array<std::string_view, 8> kLosing{"G27", "G29", "G30", "G34", "G35", "G53", "G60", "G61"};
  return std::find(kLosing.begin(), kLosing.end(), code) != kLosing.end();
}

}  // namespace

MachineState after(MachineState state, std::string_view command) {
  const CommandWords words(command);
  const std::string_view code = words.code();
  if (is_move(code)) {
    move(state, words);
  } else if (code == "G20" || code == "G21") {
    state.inches = code == "G20";
  } else if (code == "G28") {
    home(state, words);
  } else if (code == "G90" || code == "G91") {
    state.relative = state.extruder_relative = code == "G91";
  } else if (code == "M82" || code == "M83") {
    state.extruder_relative = code == "M83";
  } else if (code == "G92") {
    name_position(state, words);
  } else if (is_heating(code)) {
    heat(state, words);
  } else if (code == "M106" || code == "M107") {
    const int fan = static_cast<int>(words.number('P').value_or(0));
    state.fans[fan] = code == "M107" ? 0 : static_cast<int>(words.number('S').value_or(255));
  } else if (code == "M220") {
    state.feed_percent = words.number('S').value_or(state.feed_percent);
  } else if (code == "M221") {
    state.flow_percent = words.number('S').value_or(state.flow_percent);
  } else if (code.starts_with('T')) {
    constexpr int kMostTools = 16;
    int tool = 0;
    std::from_chars(code.data() + 1, code.data() + code.size(), tool);
    if (tool < kMostTools) state.tool = tool;
  } else if (is_setting(code)) {
    keep_setting(state, words);
  } else if (loses_position(code)) {
    state.position = {};
  }
  return state;
}

bool waits_for_moves(std::string_view command) {
  constexpr std::array<std::string_view, 7> kWaiting{"G4", "G28", "G29", "M0", "M1", "M84", "M400"};
  return std::find(kWaiting.begin(), kWaiting.end(), command_word(command)) != kWaiting.end();
}

bool places(std::string_view command) {
  constexpr std::array<std::string_view, 16> kPlacing{"G0",  "G1",  "G2",  "G3",  "G5",  "G20", "G21", "G27",
                                                      "G28", "G29", "G90", "G91", "G92", "M82", "M83", "M28"};
  const std::string_view word = command_word(command);
  return word.starts_with('T') || std::find(kPlacing.begin(), kPlacing.end(), word) != kPlacing.end();
}

std::vector<std::string> fan_commands(const MachineState& state) {
  std::vector<std::string> commands;
  for (const auto& [fan, speed] : state.fans)
    commands.push_back("M106" + word_text('P', fan) + word_text('S', speed));
  return commands;
}

MachineState with_targets(MachineState state, const TemperatureReport& report) {
  for (const HeaterReading& reading : report.heaters) {
    const std::string& name = reading.heater;
    if (name == "B") state.bed = reading.target;
    if (name == "T") state.nozzles[state.tool] = reading.target;
    const bool numbered = name.size() == 2 && name[0] == 'T' && name[1] >= '0' && name[1] <= '9';
    if (numbered) state.nozzles[name[1] - '0'] = reading.target;
  }
  return state;
}

std::vector<std::string> settings_commands(const MachineState& state) {
  std::vector<std::string> commands;
  for (const auto& [code, values] : state.settings) {
    std::string command = code;
    for (const auto& [letter, value] : values) command += word_text(letter, value);
    commands.push_back(std::move(command));
  }
  if (state.feed_percent != 100) commands.push_back("M220" + word_text('S', state.feed_percent));
  if (state.flow_percent != 100) commands.push_back("M221" + word_text('S', state.flow_percent));
  for (std::string& command : fan_commands(state)) commands.push_back(std::move(command));
  return commands;
}

}  // namespace lamina::transport
