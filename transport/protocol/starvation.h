#pragma once

#include <optional>

#include "transport/time.h"

namespace lamina::transport {

/// Why the printer's planner got no line.
enum class StarvationCause {
  kNone,      ///< it has enough, or it is not to move
  kWire,      ///< lines are on their way: the wire, or the printer itself, takes its time
  kRecovery,  ///< lines had to be sent again, or asked for
  kSource     ///< none was submitted
};

/// Time for which the planner was short of moves, by cause.
struct Starvation {
  Duration by_wire{};
  Duration by_recovery{};
  Duration by_source{};

  Duration total() const { return by_wire + by_recovery + by_source; }
};

/// Keeps the account. The planner is short of moves while more than half of its blocks are free, which
/// ADVANCED_OK tells. Where that is not told, while moves are acknowledged as soon as they arrive: then it is
/// not full, which is as much as a plain ok says.
class StarvationClock {
 public:
  /// An ok came with P, the number of free blocks.
  void planner_free(int blocks);
  /// A move was acknowledged; `at_once`: without having waited for a place.
  void move_acknowledged(bool at_once);
  /// Something that is no move has been run; the planner may be empty as it should.
  void rests() { hungry_ = false; }

  /// Time has gone on to `now`; since the last call `cause` was in the way of more lines.
  void advance(Instant now, StarvationCause cause);

  /// Short of moves just now.
  bool hungry() const { return hungry_; }

  /// Of the last ok, where the printer tells.
  std::optional<int> last_planner_free() const { return planner_free_; }
  const Starvation& total() const { return total_; }

 private:
  std::optional<int> planner_free_;
  int planner_blocks_ = 0;  ///< the most that were ever free
  bool hungry_ = false;
  std::optional<Instant> last_;
  Starvation total_;
};

}  // namespace lamina::transport
