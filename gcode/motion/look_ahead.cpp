#include "gcode/motion/look_ahead.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "gcode/motion/trapezoid.h"

namespace lamina::gcode {
namespace {

/// Marlin's MINIMUM_PLANNER_SPEED, mm/s: what it takes for standing still.
constexpr double kStandstill = 0.05;

/// Two speeds that differ by less than this share are the same to Marlin's junction rule.
constexpr double kSameSpeed = 0.99;

std::array<double, 4> as_array(const AxisValues& values) {
  return {values.x, values.y, values.z, values.e};
}

/// The largest factor by which `wanted` can be multiplied while |wanted * part| stays within the limits.
double within(double wanted, const AxisValues& parts, const AxisValues& limits) {
  const auto part = as_array(parts);
  const auto limit = as_array(limits);
  for (std::size_t axis = 0; axis < part.size(); ++axis) {
    if (limit[axis] <= 0.0) continue;  // no limit given
    const double needed = wanted * std::abs(part[axis]);
    if (needed > limit[axis]) wanted *= limit[axis] / needed;
  }
  return wanted;
}

/// How much of the jerk an axis needs to go from one speed to another: the change, or where it reverses the
/// larger of both, since it can stop in between.
double jerk_needed(double from, double to) {
  if (from * to < 0.0) return std::max(std::abs(from), std::abs(to));
  return std::abs(from - to);
}

}  // namespace

std::optional<Block> limited_block(const Segment& segment, const MachineLimits& limits) {
  const AxisValues& d = segment.delta;
  const double path = std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
  Block block;
  block.length = path > 0.0 ? path : std::abs(d.e);
  if (block.length == 0.0) return std::nullopt;
  block.tag = segment.tag;
  block.direction = {d.x / block.length, d.y / block.length, d.z / block.length, d.e / block.length};

  const double slowest = path > 0.0 && d.e == 0.0 ? limits.min_travel_feedrate : limits.min_print_feedrate;
  block.speed = within(std::max({segment.speed, slowest, kStandstill}), block.direction, limits.max_feedrate);
  double acceleration = segment.acceleration;
  if (path == 0.0) {
    acceleration = limits.retract_acceleration;
  } else if (acceleration <= 0.0) {
    acceleration = d.e != 0.0 ? limits.print_acceleration : limits.travel_acceleration;
  }
  block.acceleration = within(acceleration, block.direction, limits.max_acceleration);
  block.safe_speed = within(block.speed, block.direction, limits.max_jerk);
  block.max_entry = block.safe_speed;
  return block;
}

double junction_speed(const Block& from, const Block& to, const AxisValues& max_jerk) {
  const double speed = std::min(from.speed, to.speed);
  const auto before = as_array(from.direction);
  const auto after = as_array(to.direction);
  const auto limit = as_array(max_jerk);
  double factor = 1.0;
  for (std::size_t axis = 0; axis < limit.size(); ++axis) {
    const double jerk = jerk_needed(speed * before[axis], speed * after[axis]);
    if (limit[axis] > 0.0 && jerk > limit[axis]) factor = std::min(factor, limit[axis] / jerk);
  }
  const double junction = speed * factor;
  // Where both moves could start from a stop at this speed there is nothing to coast through.
  const double threshold = kSameSpeed * junction;
  return from.safe_speed > threshold && to.safe_speed > threshold ? to.safe_speed : junction;
}

LookAhead::LookAhead(const MachineLimits& limits, std::size_t window) : limits_(limits), window_(window) {}

std::optional<TimedSegment> LookAhead::push(const Segment& segment) {
  std::optional<Block> block = limited_block(segment, limits_);
  if (!block) return TimedSegment{segment.tag, 0.0};
  if (last_) block->max_entry = std::min(junction_speed(*last_, *block, limits_.max_jerk), block->speed);
  if (!last_) entry_ = block->max_entry;
  last_ = block;
  blocks_.push_back(*block);
  if (blocks_.size() <= window_) return std::nullopt;
  return run_first();
}

std::vector<TimedSegment> LookAhead::finish() {
  std::vector<TimedSegment> times;
  while (!blocks_.empty()) times.push_back(run_first());
  last_.reset();
  entry_ = 0.0;
  return times;
}

TimedSegment LookAhead::run_first() {
  double exit = kStandstill;
  for (std::size_t i = blocks_.size() - 1; i > 0; --i) {
    const Block& block = blocks_[i];
    exit = std::min(block.max_entry, reachable_speed(exit, block.acceleration, block.length));
  }
  const Block first = blocks_.front();
  blocks_.pop_front();
  exit = std::min({exit, first.speed, reachable_speed(entry_, first.acceleration, first.length)});
  const double seconds = duration({first.length, entry_, first.speed, exit, first.acceleration});
  entry_ = exit;
  return {first.tag, seconds};
}

}  // namespace lamina::gcode
