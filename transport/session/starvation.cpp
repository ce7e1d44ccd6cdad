#include "transport/session/starvation.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "transport/protocol/command_class.h"

namespace lamina::transport {

namespace {

/// Of a planner that was full, this many moves at least are still to run. Marlin has 16 blocks, small
/// boards 8.
constexpr std::size_t kFullPlanner = 8;

constexpr double kSecondsOfMinute = 60;

/// What the move from `before` to `after` takes at least: of a curve its chord counts.
Duration least_time(const MachineState& before, const MachineState& after) {
  if (!after.feedrate || *after.feedrate <= 0 || after.feed_percent <= 0) return {};
  double square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!before.position[axis] || !after.position[axis]) continue;
    const double way = *after.position[axis] - *before.position[axis];
    square += way * way;
  }
  const double length = square > 0 ? std::sqrt(square) : std::abs(after.e_total - before.e_total);
  return from_seconds(length / (*after.feedrate / kSecondsOfMinute * after.feed_percent / 100));
}

}  // namespace

void StarvationClock::advance(Instant now, Obstacle obstacle) {
  const Instant since = std::max(last_.value_or(now), ends_.value_or(now));
  last_ = now;
  if (!ends_ || since >= now) return;
  switch (obstacle) {
    case Obstacle::kNone:
      break;
    case Obstacle::kWire:
      pending_.by_wire += now - since;
      break;
    case Obstacle::kRecovery:
      pending_.by_recovery += now - since;
      break;
    case Obstacle::kSource:
      pending_.by_source += now - since;
      break;
  }
}

void StarvationClock::acknowledged(const LineAcknowledged& line, Instant now) {
  const MachineState before = printer_;
  printer_ = after(std::move(printer_), line.line.command);
  switch (classify(line.line.command)) {
    case CommandClass::kQuick:
      return;
    case CommandClass::kBlocking:
      // The planner is empty as it should be.
      settle(false);
      ends_.reset();
      return;
    case CommandClass::kMotion:
      break;
  }
  recent_.push_back(least_time(before, printer_));
  if (recent_.size() >= kFullPlanner) recent_.pop_front();
  settle(line.at_once);
  ends_ = std::max(ends_.value_or(now), now) + recent_.back();
  if (line.at_once) return;
  // The oldest of them may be about to end.
  const auto counted = static_cast<std::ptrdiff_t>(std::min(kFullPlanner - 1, recent_.size()));
  ends_ = std::max(*ends_, now + std::accumulate(recent_.end() - counted, recent_.end(), Duration{}));
}

void StarvationClock::settle(bool was_short) {
  if (was_short) {
    total_.by_wire += pending_.by_wire;
    total_.by_recovery += pending_.by_recovery;
    total_.by_source += pending_.by_source;
  }
  pending_ = {};
}

}  // namespace lamina::transport
