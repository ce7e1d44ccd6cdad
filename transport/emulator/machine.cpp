#include "transport/emulator/machine.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace lamina::transport {

namespace {

constexpr std::array<char, 4> kAxes{'X', 'Y', 'Z', 'E'};

/// How far an axis backs off its end stop before it touches it again, slowly.
constexpr double kHomingBump = 5;  // mm

}  // namespace

Machine::Machine(const EmulatorOptions& options, Instant now)
    : motion_(options.motion),
      planner_(options.motion),
      hotend_(options.thermal.hotend, options.thermal.room, now),
      bed_(options.thermal.bed, options.thermal.room, now),
      record_(options.record, options.motion.filament_diameter) {}

void Machine::name_position(const GcodeCommand& command) {
  const bool all = std::none_of(kAxes.begin(), kAxes.end(), [&](char axis) { return command.has(axis); });
  for (std::size_t axis = 0; axis < 4; ++axis) {
    if (!all && !command.has(kAxes[axis])) continue;
    const double named = command.value(kAxes[axis]).value_or(0) * modes_.unit;
    if (axis == 3) {
      planned_[axis] = named;  // the extruder has no place of its own
    } else {
      modes_.shift[axis] = named - planned_[axis];
    }
  }
}

MachinePosition Machine::destination(const GcodeCommand& command) {
  MachinePosition target = planned_;
  for (std::size_t axis = 0; axis < 4; ++axis) {
    const std::optional<double> value = command.value(kAxes[axis]);
    if (!value) continue;
    const bool relative = axis == 3 ? modes_.extruder_relative : modes_.relative;
    target[axis] =
        relative ? planned_[axis] + *value * modes_.unit : *value * modes_.unit - modes_.shift[axis];
  }
  if (const std::optional<double> feed = command.value('F'); feed && *feed > 0)
    modes_.feedrate = *feed * modes_.unit / 60;
  return target;
}

Machine::Prepared Machine::prepare_move(MachinePosition target, double feedrate) {
  if (objects_.skipping()) {
    planned_[3] = target[3];
    return {};
  }
  bool outside = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double inside = std::clamp(target[axis], motion_.bed_min[axis], motion_.bed_max[axis]);
    // A hair of rounding is not outside.
    outside = outside || std::abs(inside - target[axis]) > 1e-6;
    if (modes_.soft_limits && modes_.homed[axis]) target[axis] = inside;
  }
  if (outside) ++record_.report().outside_moves;

  return prepare(target, target[3] - planned_[3], feedrate);
}

Machine::Prepared Machine::prepare_retraction(double length, double feedrate) {
  return prepare(planned_, length, feedrate);
}

Machine::Prepared Machine::prepare(const MachinePosition& target, double extrusion, double feedrate) {
  Prepared prepared;
  PlannedMove move{planned_, target, feedrate, 0};
  planned_ = target;
  if (extrusion != 0 && hotend_.temperature() < motion_.min_extrude_temperature) {
    ++record_.report().cold_extrusions;
    prepared.message = "echo: cold extrusion prevented\n";
    extrusion = 0;
  } else if (std::abs(extrusion) > motion_.max_extrude_length) {
    ++record_.report().too_long_extrusions;
    prepared.message = "echo: too long extrusion prevented\n";
    extrusion = 0;
  }
  extrusion *= modes_.flow_percent / 100;
  move.from[3] = 0;
  move.to[3] = extrusion;
  move.deposited = record_.deposit(extrusion);
  const bool moves = move.from != move.to;
  if (moves) prepared.move = move;
  return prepared;
}

void Machine::start_move(const PlannedMove& move, Instant now) {
  if (ran_dry_ && !standstill_expected_) {
    PrintReport& report = record_.report();
    const Duration dry = now - *ran_dry_;
    ++report.underruns;
    report.starved += dry;
    report.longest_starved = std::max(report.longest_starved, dry);
  }
  if (oozes_since_)
    record_.report().longest_ooze = std::max(record_.report().longest_ooze, now - *oozes_since_);
  oozes_since_.reset();
  ran_dry_.reset();
  standstill_expected_ = false;
  if (!first_move_) first_move_ = now;
  planner_.push(move, now);
}

Duration Machine::homing_time(const std::array<bool, 3>& axes) const {
  double seconds = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!axes[axis]) continue;
    const double feedrate = motion_.homing_feedrate[axis];
    const double way = std::abs(planned_[axis] - motion_.bed_min[axis]) + kHomingBump;
    seconds += way / feedrate + kHomingBump / (feedrate / 2);
  }
  return from_seconds(seconds);
}

void Machine::finish_homing(const std::array<bool, 3>& axes) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!axes[axis]) continue;
    planned_[axis] = motion_.bed_min[axis];
    displacement_[axis] = 0;
    modes_.shift[axis] = 0;
    modes_.homed[axis] = true;
  }
  planner_.set_position(planned_);
}

void Machine::forget(Instant now) {
  stop(now);
  modes_ = {};
  objects_ = {};
  for (std::size_t axis = 0; axis < 3; ++axis) displacement_[axis] += planned_[axis];
  planned_ = {};
  planner_.set_position(planned_);
  hotend_.set_target(0);
  bed_.set_target(0);
}

PlannedMove Machine::displaced(PlannedMove move) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    move.from[axis] += displacement_[axis];
    move.to[axis] += displacement_[axis];
  }
  return move;
}

void Machine::stop(Instant now) {
  planner_.stop(now);
  const MachinePosition at = planner_.position(now);
  std::copy_n(at.begin(), 3, planned_.begin());
  ran_dry_.reset();
  oozes_since_.reset();
}

void Machine::advance(Instant now) {
  hotend_.advance(now);
  bed_.advance(now);
  while (const std::optional<Instant> next = planner_.next_event()) {
    if (*next > now) break;
    const std::optional<PlannedMove> ended = planner_.advance(now);
    if (!ended) continue;
    record_.add(displaced(*ended));
    record_.report().moving = *next - *first_move_;
    if (ended->to[3] != ended->from[3]) pressure_ = ended->to[3] > ended->from[3];
    if (!planner_.empty()) continue;
    if (ended->deposited > 0) ran_dry_ = *next;
    if (pressure_ && hotend_.temperature() >= motion_.min_extrude_temperature) oozes_since_ = *next;
  }
}

std::string Machine::temperatures() const {
  return fmt::format(" T:{:.2f} /{:.2f} B:{:.2f} /{:.2f} @:{} B@:{}", hotend_.temperature(), hotend_.target(),
                     bed_.temperature(), bed_.target(), hotend_.power(), bed_.power());
}

std::string Machine::position(Instant now) const {
  const MachinePosition at = planner_.position(now);
  const auto steps = [&](std::size_t axis) { return std::llround(at[axis] * motion_.steps_per_mm[axis]); };
  return fmt::format("X:{:.2f} Y:{:.2f} Z:{:.2f} E:{:.2f} Count X:{} Y:{} Z:{}",
                     planned_[0] + modes_.shift[0], planned_[1] + modes_.shift[1],
                     planned_[2] + modes_.shift[2], planned_[3], steps(0), steps(1), steps(2));
}

}  // namespace lamina::transport
