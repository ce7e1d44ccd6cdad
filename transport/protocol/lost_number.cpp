#include "transport/protocol/lost_number.h"

#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "transport/protocol/command_class.h"
#include "transport/protocol/command_words.h"

namespace lamina::transport {

namespace {

constexpr std::array kAxes{'X', 'Y', 'Z'};

/// M114 tells hundredths of a mm.
constexpr double kRounding = 0.0051;

/// Where a move begins and ends, along the axes of which that is known.
struct Ends {
  std::array<std::optional<double>, 3> from;
  std::array<std::optional<double>, 3> to;
};

/// Before it, nothing is known of where the printer was, or of what the words of a move meant.
bool forgets_place(const NumberedLine& line) {
  return line.command.starts_with('G') && classify(line.command) != CommandClass::kMotion;
}

/// None unless the line is a move that extrudes.
std::optional<Ends> ends_of(const LineHistory& history, LineNumber number) {
  const NumberedLine& line = history.at(number);
  const CommandWords words(line.command);
  if (classify(line.command) != CommandClass::kMotion || !words.has('E')) return std::nullopt;
  Ends ends;
  for (LineNumber before = number - 1; before >= history.first(); --before) {
    if (forgets_place(history.at(before))) break;
    if (classify(history.at(before).command) != CommandClass::kMotion) continue;
    const CommandWords earlier(history.at(before).command);
    for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
      if (!ends.from[axis]) ends.from[axis] = earlier.number(kAxes[axis]);
    }
    if (ends.from[0] && ends.from[1] && ends.from[2]) break;
  }
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    const std::optional<double> target = words.number(kAxes[axis]);
    ends.to[axis] = target ? target : ends.from[axis];
  }
  return ends;
}

bool is_at(const std::array<double, 3>& place, const std::array<std::optional<double>, 3>& point) {
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    if (point[axis] && std::abs(place[axis] - *point[axis]) > kRounding) return false;
  }
  return true;
}

bool apart(const Ends& ends) {
  for (std::size_t axis = 0; axis < kAxes.size(); ++axis) {
    if (ends.from[axis] && std::abs(*ends.from[axis] - *ends.to[axis]) > 2 * kRounding) return true;
  }
  return false;
}

}  // namespace

bool may_lack_number(std::string_view error) {
  const auto says = [error](std::string_view words) { return error.find(words) != std::string_view::npos; };
  return !says("checksum mismatch") && !says("not Last Line Number+1");
}

std::string place_question(LineNumber last) {
  return fmt::format("M114 M110 N{}", last);
}

bool tells_by_place(const LineHistory& history, LineNumber number) {
  const std::optional<Ends> ends = ends_of(history, number);
  return ends && apart(*ends);
}

MoveTaken move_taken(const LineHistory& history, LineNumber number, const PositionReply& place) {
  const std::optional<Ends> ends = ends_of(history, number);
  if (!ends || !apart(*ends)) return MoveTaken::kUnclear;
  const std::array<double, 3> at{place.x, place.y, place.z};
  if (is_at(at, ends->to)) return MoveTaken::kYes;
  return is_at(at, ends->from) ? MoveTaken::kNo : MoveTaken::kUnclear;
}

}  // namespace lamina::transport
