#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>

#include "transport/protocol/protocol_engine.h"
#include "transport/session/machine_state.h"
#include "transport/time.h"

namespace lamina::transport {

/// Time that the motion lost because moves came too late, by what kept them: the planner had none to run, or
/// so few that the firmware ran them slower (with less than half of its blocks in use, Marlin stretches short
/// ones).
struct Starvation {
  Duration by_wire{};      ///< lines were on their way: the link is too slow for so short moves
  Duration by_recovery{};  ///< lines had to be sent again, or asked for
  Duration by_source{};    ///< none was ready: the slicer, or who else makes them, was too slow

  Duration total() const { return by_wire + by_recovery + by_source; }
};

/// Estimates that from what the host can know: when each move was acknowledged, the least time that it can
/// take (its way at its feed rate), and whether its line had to wait for a place in the planner, which then
/// was full. What the firmware runs slower than at the feed rate for other reasons, on a link that is too
/// slow anyway, is counted too; what it stretches until its planner is full again for a moment is not.
class StarvationClock {
 public:
  /// Time has gone on to `now`; since the last call `obstacle` has been in the way of more lines.
  void advance(Instant now, Obstacle obstacle);

  /// A line was acknowledged at `now`, up to which `advance` was called.
  void acknowledged(const LineAcknowledged& line, Instant now);

  const Starvation& total() const { return total_; }

 private:
  void settle(bool was_short);

  MachineState printer_;
  std::deque<Duration> recent_;  ///< what the last moves take at least, the newest last
  /// When the last one ends at the earliest. None: no move is expected to follow another just now.
  std::optional<Instant> ends_;
  std::optional<Instant> last_;
  Starvation pending_;  ///< if the next move confirms it
  Starvation total_;
};

}  // namespace lamina::transport
