#include "transport/emulator/planner.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace lamina::transport {

namespace {

/// Blocks that make the first one start without its delay.
constexpr std::size_t kCompany = 3;

double dot(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 4; ++axis) sum += a[axis] * b[axis];
  return sum;
}

/// The speed from which a stop down to `target` is possible over `length`.
double reachable_speed(double target, double acceleration, double length) {
  return std::sqrt(target * target + 2 * acceleration * length);
}

}  // namespace

Planner::Planner(const MotionOptions& options) : options_(options) {}

void Planner::push(const PlannedMove& move, Instant now) {
  assert(free() > 0);
  Block block = make_block(move);
  block.max_entry_speed = options_.minimum_speed;
  if (options_.jerk) {
    // From a standstill every axis may jump to its jerk.
    block.max_entry_speed = block.speed;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      const double share = std::abs(block.direction[axis]);
      if (share > 0) block.max_entry_speed = std::min(block.max_entry_speed, (*options_.jerk)[axis] / share);
    }
  }
  if (waiting_blocks() > 0) block.max_entry_speed = junction_speed(blocks_.back(), block);
  if (blocks_.empty()) {
    delayed_ = true;
    may_start_ = now + options_.first_block_delay;
  }
  blocks_.push_back(block);
  look_ahead();
  if (delayed_ && blocks_.size() >= kCompany) may_start_ = std::min(may_start_, now);
}

std::optional<Instant> Planner::next_event() const {
  if (blocks_.empty()) return std::nullopt;
  if (running_) return ends_;
  return delayed_ ? may_start_ : ends_;
}

std::optional<PlannedMove> Planner::advance(Instant now) {
  if (blocks_.empty()) return std::nullopt;
  std::optional<PlannedMove> ended;
  Instant next_start = may_start_;
  if (running_) {
    if (ends_ > now) return std::nullopt;
    ended = blocks_.front().move;
    position_ = ended->to;
    blocks_.pop_front();
    running_.reset();
    if (blocks_.empty()) return ended;
    next_start = ends_;
  } else if (may_start_ > now) {
    return std::nullopt;
  }
  delayed_ = false;
  const Block& block = blocks_.front();
  const double exit_speed = blocks_.size() > 1 ? blocks_[1].entry_speed : options_.minimum_speed;
  running_ = make_trapezoid(block.length, block.entry_speed, block.speed, exit_speed, block.acceleration);
  started_ = next_start;
  ends_ = started_ + from_seconds(running_->duration());
  return ended;
}

void Planner::stop(Instant now) {
  position_ = position(now);
  blocks_.clear();
  running_.reset();
  delayed_ = false;
}

MachinePosition Planner::position(Instant now) const {
  if (!running_) return position_;
  const Block& block = blocks_.front();
  const double part = block.length > 0 ? running_->distance_at(to_seconds(now - started_)) / block.length : 1;
  MachinePosition at{};
  for (std::size_t axis = 0; axis < 4; ++axis) {
    at[axis] = block.move.from[axis] + part * (block.move.to[axis] - block.move.from[axis]);
  }
  return at;
}

Planner::Block Planner::make_block(const PlannedMove& move) const {
  Block block{move};
  std::array<double, 4> way{};
  for (std::size_t axis = 0; axis < 4; ++axis) way[axis] = move.to[axis] - move.from[axis];
  block.length = std::hypot(way[0], way[1], way[2]);
  const bool extruder_only = block.length == 0;
  if (extruder_only) block.length = std::abs(way[3]);
  assert(block.length > 0);

  double time = block.length / move.feedrate;
  const std::size_t waiting = waiting_blocks();
  const double min_time = to_seconds(options_.min_segment_time);
  if (waiting >= 2 && waiting < options_.block_buffer / 2 && time < min_time) {
    time += 2 * (min_time - time) / static_cast<double>(waiting);
  }
  for (std::size_t axis = 0; axis < 4; ++axis)
    time = std::max(time, std::abs(way[axis]) / options_.max_feedrate[axis]);
  block.speed = block.length / time;

  for (std::size_t axis = 0; axis < 4; ++axis) block.direction[axis] = way[axis] / block.length;
  const double acceleration = extruder_only ? options_.retract_acceleration
                              : way[3] != 0 ? options_.acceleration
                                            : options_.travel_acceleration;
  block.acceleration = limit_by_axis(acceleration, block.direction);
  return block;
}

double Planner::limit_by_axis(double acceleration, const std::array<double, 4>& direction) const {
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const double share = std::abs(direction[axis]);
    if (share * acceleration > options_.max_acceleration[axis])
      acceleration = options_.max_acceleration[axis] / share;
  }
  return acceleration;
}

/// Junction deviation: the speed at which a circle that leaves the corner by that much is run at the allowed
/// acceleration. Directions have E in them, as in Marlin, and are brought back to unit length.
double Planner::junction_speed(const Block& before, const Block& after) const {
  if (options_.jerk) return jerk_speed(before, after);
  const auto unit = [](std::array<double, 4> direction) {
    const double length = std::sqrt(dot(direction, direction));
    for (double& component : direction) component /= length;
    return direction;
  };
  const std::array<double, 4> in = unit(before.direction);
  const std::array<double, 4> out = unit(after.direction);
  const double cosine =
      std::max(-dot(in, out), -0.999999);  // of the angle between the two ways, 180 deg = straight on
  if (cosine > 0.999999) return options_.minimum_speed;
  std::array<double, 4> turn{};
  for (std::size_t axis = 0; axis < 4; ++axis) turn[axis] = out[axis] - in[axis];
  if (dot(turn, turn) == 0) return std::min(before.speed, after.speed);
  const double acceleration = limit_by_axis(after.acceleration, unit(turn));
  const double sine_half = std::sqrt((1 - cosine) / 2);
  double speed_squared = acceleration * options_.junction_deviation * sine_half / (1 - sine_half);
  // Short segments of a curve: by the radius that their angle stands for.
  if (after.length < 1 && cosine < -std::numbers::sqrt2 / 2) {
    const double turned = std::numbers::pi - std::acos(cosine);
    speed_squared = std::min(speed_squared, after.length * acceleration / turned);
  }
  return std::min({std::sqrt(speed_squared), before.speed, after.speed});
}

/// Classic jerk: the speed at which no axis changes its own by more than its jerk at once. An axis that turns
/// round changes by as much as it had before or gets after, whichever is more: Marlin does not add them.
double Planner::jerk_speed(const Block& before, const Block& after) const {
  const double speed = std::min(before.speed, after.speed);
  double share = 1;
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const double in = before.direction[axis] * speed;
    const double out = after.direction[axis] * speed;
    const double change = in * out < 0 ? std::max(std::abs(in), std::abs(out)) : std::abs(out - in);
    if (change > (*options_.jerk)[axis]) share = std::min(share, (*options_.jerk)[axis] / change);
  }
  return std::max(options_.minimum_speed, speed * share);
}

void Planner::look_ahead() {
  // The running block keeps the exit speed it was started with, and so the next one its entry speed.
  const std::size_t first = running_ ? 1 : 0;
  double next_entry = options_.minimum_speed;
  for (std::size_t i = blocks_.size(); i-- > first;) {
    Block& block = blocks_[i];
    const bool fixed = running_ && i == 1;
    const double entry =
        std::min(block.max_entry_speed, reachable_speed(next_entry, block.acceleration, block.length));
    if (!fixed) block.entry_speed = entry;
    next_entry = block.entry_speed;
  }
  if (running_ && blocks_.size() > 1) blocks_[1].entry_speed = running_->exit_speed;
  for (std::size_t i = first; i + 1 < blocks_.size(); ++i) {
    const Block& block = blocks_[i];
    Block& next = blocks_[i + 1];
    next.entry_speed =
        std::min(next.entry_speed, reachable_speed(block.entry_speed, block.acceleration, block.length));
  }
}

}  // namespace lamina::transport
