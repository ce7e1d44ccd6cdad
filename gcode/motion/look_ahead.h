#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "gcode/motion/machine_limits.h"

namespace lamina::gcode {

/// A straight move of all axes.
struct Segment {
  AxisValues delta;    ///< mm; e in mm of filament
  double speed = 0.0;  ///< Wanted along the path (along the filament when only e moves), mm/s; positive.
  double acceleration = 0.0;  ///< Wanted, mm/s^2; 0 = the machine's own for this kind of move.
  std::size_t tag = 0;        ///< Given back with the time.
};

struct TimedSegment {
  std::size_t tag = 0;
  double seconds = 0.0;
};

/// Speed, acceleration and direction of a move once the machine's limits have been applied.
struct Block {
  double length = 0.0;        ///< mm
  AxisValues direction;       ///< delta / length
  double speed = 0.0;         ///< mm/s
  double acceleration = 0.0;  ///< mm/s^2
  double safe_speed = 0.0;    ///< From and to which no axis changes by more than its jerk, mm/s.
  double max_entry = 0.0;     ///< mm/s
  std::size_t tag = 0;
};

/// The limits applied to one move; nothing when it has no length.
std::optional<Block> limited_block(const Segment& segment, const MachineLimits& limits);

/// Largest speed at which one move may pass into the next, mm/s: Marlin's classic jerk
/// (Planner::_populate_block of Marlin 2): no axis changes its speed by more than its jerk.
double junction_speed(const Block& from, const Block& to, const AxisValues& max_jerk);

/// How long moves take on a machine that plans as Marlin does: a window of the next moves is known, the last
/// one of them must be able to stop, and junctions and accelerations are kept.
class LookAhead {
 public:
  /// `window` moves are known beyond the one that runs (Marlin's BLOCK_BUFFER_SIZE is 16).
  explicit LookAhead(const MachineLimits& limits, std::size_t window = 16);

  /// Adds a move. Once the window is full each call gives back the time of the oldest move.
  std::optional<TimedSegment> push(const Segment& segment);

  /// The machine stops at the end of the last move: the times of all moves that are left.
  std::vector<TimedSegment> finish();

 private:
  TimedSegment run_first();

  MachineLimits limits_;
  std::size_t window_;
  std::deque<Block> blocks_;
  std::optional<Block> last_;  ///< The newest move, even when it has already run.
  double entry_ = 0.0;         ///< Speed at which the oldest move begins, mm/s.
};

}  // namespace lamina::gcode
