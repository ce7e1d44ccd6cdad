#include "gcode/marlin/gcode_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace lamina::gcode {
namespace {

using engine::Vector3;

constexpr double kInch = 25.4;
constexpr std::size_t kUnreadableKept = 10;
constexpr std::array<char, 3> kAxes{'X', 'Y', 'Z'};

std::size_t count_after(std::string_view text, std::size_t prefix) {
  std::size_t count = 0;
  std::from_chars(text.data() + prefix, text.data() + text.size(), count);
  return count;
}

}  // namespace

GcodeReader::GcodeReader(const MachineLimits& limits) : machine_(limits) {}

void GcodeReader::read(std::string_view line) {
  ++summary_.lines;
  try {
    run(parse_line(line, summary_.lines));
  } catch (const GcodeError& error) {
    ++summary_.unreadable_lines;
    if (summary_.unreadable.size() < kUnreadableKept) summary_.unreadable.emplace_back(error.what());
  }
}

GcodeSummary GcodeReader::summary() const {
  GcodeSummary summary = summary_;
  LookAhead rest = machine_;
  for (const TimedSegment& timed : rest.finish()) summary.seconds += timed.seconds;
  return summary;
}

void GcodeReader::run(const GcodeLine& line) {
  if (line.comment) read_comment(*line.comment);
  if (!line.command) return;
  ++summary_.commands;
  if (line.command->subcode) return;
  if (line.command->letter == 'M') {
    if (line.command->number == 82) relative_extrusion_ = false;
    if (line.command->number == 83) relative_extrusion_ = true;
    return;
  }
  if (line.command->letter != 'G') return;
  switch (line.command->number) {
    case 2:
    case 3:
      ++summary_.arcs;
      [[fallthrough]];
    case 0:
    case 1:
      move(line);
      break;
    case 4:
      summary_.seconds += line.value('S').value_or(line.value('P').value_or(0.0) / 1000.0);
      break;
    case 20:
      unit_ = kInch;
      break;
    case 21:
      unit_ = 1.0;
      break;
    case 28:
      home(line);
      break;
    case 90:
      relative_ = relative_extrusion_ = false;
      break;
    case 91:
      relative_ = relative_extrusion_ = true;
      break;
    case 92:
      set_position(line);
      break;
    default:
      break;
  }
}

void GcodeReader::move(const GcodeLine& line) {
  Vector3 target = position_;
  for (int axis = 0; axis < 3; ++axis) {
    if (const auto word = line.value(kAxes[static_cast<std::size_t>(axis)])) {
      target[axis] = *word * unit_ + (relative_ ? position_[axis] : origin_[axis]);
    }
  }
  double extrusion = 0.0;
  if (const auto word = line.value('E')) {
    extrusion = *word * unit_ - (relative_extrusion_ ? 0.0 : extruder_);
    extruder_ += extrusion;
  }
  if (const auto word = line.value('F')) feedrate_ = *word * unit_;

  const Vector3 way = target - position_;
  filament_ += extrusion;
  summary_.filament_length = std::max(summary_.filament_length, filament_);
  if (way.norm() > 0.0 && extrusion > 0.0) {
    summary_.extrusion_bounds.extend(position_);
    summary_.extrusion_bounds.extend(target);
    summary_.max_z = std::max(summary_.max_z, target.z());
    summary_.extrusion_length += way.norm();
    if (!marked_layers_ && target.z() > last_layer_z_) {
      last_layer_z_ = target.z();
      ++summary_.layers;
    }
  } else {
    summary_.travel_length += way.norm();
  }
  const Segment segment{{way.x(), way.y(), way.z(), extrusion}, feedrate_ / 60.0, 0.0, 0};
  if (const auto timed = machine_.push(segment)) summary_.seconds += timed->seconds;
  position_ = target;
}

void GcodeReader::home(const GcodeLine& line) {
  const bool all = std::ranges::none_of(
      line.words, [](const Word& word) { return std::ranges::find(kAxes, word.letter) != kAxes.end(); });
  for (int axis = 0; axis < 3; ++axis) {
    const bool named = std::ranges::find(line.words, kAxes[static_cast<std::size_t>(axis)], &Word::letter) !=
                       line.words.end();
    if (all || named) position_[axis] = origin_[axis] = 0.0;
  }
}

void GcodeReader::set_position(const GcodeLine& line) {
  for (int axis = 0; axis < 3; ++axis) {
    if (const auto word = line.value(kAxes[static_cast<std::size_t>(axis)])) {
      origin_[axis] = position_[axis] - *word * unit_;
    }
  }
  if (const auto word = line.value('E')) extruder_ = *word * unit_;
}

void GcodeReader::read_comment(std::string_view comment) {
  constexpr std::string_view kCount = "LAYER_COUNT:";
  if (comment.starts_with(kCount)) summary_.announced_layers = count_after(comment, kCount.size());
  if (comment != "LAYER_CHANGE") return;
  if (!marked_layers_) summary_.layers = 0;  // what came before is not counted in layers
  marked_layers_ = true;
  ++summary_.layers;
}

GcodeSummary summarize(std::istream& file, const MachineLimits& limits) {
  GcodeReader reader(limits);
  std::string line;
  while (std::getline(file, line)) reader.read(line);
  return reader.summary();
}

}  // namespace lamina::gcode
