#include "transport/session/command_filter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "transport/protocol/command_class.h"
#include "transport/protocol/command_words.h"
#include "transport/protocol/line_stripper.h"
#include "transport/session/curve_chords.h"

namespace lamina::transport {

namespace {

constexpr double kInch = 25.4;
constexpr double kRetractFeedrate = 2100;  // mm/min, of the moves that step around a skipped object
constexpr double kTravelFeedrate = 6000;
constexpr double kLiftFeedrate = 600;

bool is_curve(std::string_view code) {
  return code == "G2" || code == "G3" || code == "G5";
}
bool is_move(std::string_view code) {
  return code == "G0" || code == "G1" || is_curve(code);
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
    text.remove_suffix(1);
  return text;
}

/// Numbers go out rounded. Relative ones are rounded so that their sum stays right.
class Coordinate {
 public:
  Coordinate(double from, bool relative, double unit) : sent_(from), relative_(relative), unit_(unit) {}

  /// The number that leads to `to` (mm).
  double number(double to) {
    constexpr double kDigits = 1e5;
    const double wanted = (relative_ ? to - sent_ : to) / unit_;
    const double rounded = std::round(wanted * kDigits) / kDigits;
    sent_ = relative_ ? sent_ + rounded * unit_ : rounded * unit_;
    return rounded;
  }

 private:
  double sent_;
  bool relative_;
  double unit_;
};

/// The chords of a curve command as G1. None where it cannot be drawn: no start, no radius.
std::optional<std::vector<std::string>> straightened(const std::string& command, const MachineState& from,
                                                     double tolerance) {
  const CommandWords words(command);
  if (!from.position[0] || !from.position[1]) return std::nullopt;
  const MachineState to = after(from, command);
  const double unit = from.inches ? kInch : 1;
  const PlanePoint start{*from.position[0], *from.position[1]};
  const PlanePoint end{*to.position[0], *to.position[1]};
  const auto length = [&](char letter) { return words.number(letter).value_or(0) * unit; };
  std::vector<PlanePoint> ends;
  if (words.code() == "G5") {
    ends = chords({start, PlanePoint{start[0] + length('I'), start[1] + length('J')},
                   PlanePoint{end[0] + length('P'), end[1] + length('Q')}, end},
                  tolerance);
  } else {
    const bool clockwise = words.code() == "G2";
    const auto arc = words.number('R') ? arc_of_radius(start, end, length('R'), clockwise)
                                       : arc_by_offset(start, end, {length('I'), length('J')}, clockwise);
    if (!arc) return std::nullopt;
    ends = chords(*arc, tolerance);
  }
  Coordinate x(start[0], from.relative, unit);
  Coordinate y(start[1], from.relative, unit);
  Coordinate z(from.position[2].value_or(0), from.relative, unit);
  Coordinate e(from.e, from.extruder_relative, unit);
  std::vector<std::string> commands;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const double share = static_cast<double>(i + 1) / static_cast<double>(ends.size());
    std::string chord = "G1" + word_text('X', x.number(ends[i][0])) + word_text('Y', y.number(ends[i][1]));
    if (words.has('Z') && from.position[2])
      chord += word_text('Z', z.number(std::lerp(*from.position[2], *to.position[2], share)));
    if (words.has('E')) chord += word_text('E', e.number(std::lerp(from.e, to.e, share)));
    if (const auto feedrate = words.number('F'); feedrate && i == 0) chord += word_text('F', *feedrate);
    commands.push_back(std::move(chord));
  }
  return commands;
}

double retracted(const MachineState& state) {
  return state.e_peak - state.e_total;
}

/// Leads the printer from where skipping an object left it to where the file goes on. Both have the same
/// modes.
void step_over(const MachineState& from, const MachineState& to, std::vector<std::string>& commands) {
  const double push = retracted(from) - retracted(to);
  const auto extrude = [&](double length) {
    commands.push_back("G1" + word_text('E', length) + word_text('F', kRetractFeedrate));
  };
  if (to.inches) commands.emplace_back("G21");
  if (to.relative) commands.emplace_back("G90");
  commands.emplace_back("M83");
  if (push < 0) extrude(push);
  const bool goes_up = to.position[2] && from.position[2] && *to.position[2] > *from.position[2];
  const bool goes_down = to.position[2] && !goes_up;
  const std::string height =
      to.position[2] ? "G1" + word_text('Z', *to.position[2]) + word_text('F', kLiftFeedrate) : "";
  if (goes_up) commands.push_back(height);
  if (to.position[0] && to.position[1]) {
    commands.push_back("G1" + word_text('X', *to.position[0]) + word_text('Y', *to.position[1]) +
                       word_text('F', kTravelFeedrate));
  }
  if (goes_down) commands.push_back(height);
  if (push > 0) extrude(push);
  if (to.feedrate) commands.push_back("G1" + word_text('F', *to.feedrate));
  commands.push_back("G92" + word_text('E', to.e));
  if (to.inches) commands.emplace_back("G20");
  if (to.relative) commands.emplace_back("G91");
  commands.emplace_back(to.extruder_relative ? "M83" : "M82");
}

/// The object that begins (its name), ends (empty), or neither (none) with this comment.
std::optional<std::string_view> object_marker(std::string_view line) {
  line = trim(line);
  if (!line.starts_with(';')) return std::nullopt;
  const std::string_view comment = trim(line.substr(1));
  constexpr std::string_view kBegin = "printing object ";
  constexpr std::string_view kEnd = "stop printing object";
  constexpr std::string_view kMesh = "MESH:";
  if (comment.starts_with(kEnd)) return "";
  if (comment.starts_with(kBegin)) return trim(comment.substr(kBegin.size()));
  if (comment.starts_with(kMesh)) {
    const std::string_view mesh = trim(comment.substr(kMesh.size()));
    return mesh == "NONMESH" ? std::string_view{} : mesh;
  }
  return std::nullopt;
}

}  // namespace

CommandFilter::CommandFilter(FilterOptions options) : options_(options) {}

std::vector<std::string> CommandFilter::push(std::string_view line) {
  std::vector<std::string> commands;
  if (const auto marker = object_marker(line)) {
    enter_object(marker->empty() ? std::nullopt : std::optional<std::string>(*marker), commands);
  }
  std::string command = strip_line(line);
  // The numbering on this wire is ours, and the firmware would see this text anywhere in a line.
  if (!command.empty() && command.find("M110") == std::string::npos) run(std::move(command), commands);
  return commands;
}

void CommandFilter::enter_object(std::optional<std::string> object, std::vector<std::string>& commands) {
  if (object) objects_.insert(*object);
  state_.object = std::move(object);
  const bool skip = state_.object && state_.skipped.contains(*state_.object) && !dialect_.objects;
  if (state_.skipping_from && !skip) {
    step_over(*state_.skipping_from, state_.file, commands);
    state_.skipping_from.reset();
  }
  if (skip && !state_.skipping_from) state_.skipping_from = state_.file;
}

void CommandFilter::run(std::string command, std::vector<std::string>& commands) {
  const std::string_view code = command_word(command);
  if (code == "M486") {
    const auto number = CommandWords(command).number('S');
    if (number) {
      enter_object(*number < 0 ? std::nullopt : std::optional(number_text(*number)), commands);
    }
    if (!dialect_.objects || dialect_.lacking.contains("M486")) return;
  }
  // The object may have been skipped since it began.
  if (!state_.skipping_from && state_.object && state_.skipped.contains(*state_.object) && !dialect_.objects)
    state_.skipping_from = state_.file;

  const MachineState before = state_.file;
  state_.file = after(std::move(state_.file), command);
  if (code == "G17" || code == "G18" || code == "G19") state_.other_plane = code != "G17";
  if ((code == "M73" && !dialect_.progress) || dialect_.lacking.contains(std::string(code))) return;
  if (state_.skipping_from) {
    if (is_move(code) || code == "G92") return;
    state_.skipping_from = after(*std::move(state_.skipping_from), command);
  }
  const bool unknown_curve = code == "G5" ? !dialect_.bezier : is_curve(code) && !dialect_.arcs;
  if (unknown_curve && !state_.other_plane) {
    if (auto chords = straightened(command, before, options_.chord_tolerance)) {
      std::move(chords->begin(), chords->end(), std::back_inserter(commands));
      return;
    }
  }
  commands.push_back(std::move(command));
}

}  // namespace lamina::transport
