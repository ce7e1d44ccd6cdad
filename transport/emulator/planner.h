#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>

#include "transport/emulator/emulator_options.h"
#include "transport/emulator/trapezoid.h"
#include "transport/time.h"

namespace lamina::transport {

/// Where the machine is, X, Y, Z and E in mm.
using MachinePosition = std::array<double, 4>;

/// A straight move for the planner.
struct PlannedMove {
  MachinePosition from{};
  MachinePosition to{};
  double feedrate = 0;   ///< mm/s along the way (of the filament where nothing else moves)
  double deposited = 0;  ///< mm of filament that leave the nozzle; carried for the record
};

/// Marlin's planner and stepper: a buffer of blocks with look-ahead by junction deviation or by classic jerk,
/// run off in time.
///
/// Speeds follow Marlin 2.1: a block enters at most as fast as junction deviation, both neighbours' speeds
/// and the way left to stop allow; the block being run keeps the exit speed that it was started with; while
/// fewer than half of the blocks are queued, short segments are stretched; the first block after a pause
/// waits a little for a second one.
class Planner {
 public:
  explicit Planner(const MotionOptions& options);

  /// Free places. A move needs one.
  std::size_t free() const { return options_.block_buffer - 1 - blocks_.size(); }
  bool empty() const { return blocks_.empty(); }

  /// Adds a move of non-zero length. There must be a free place.
  void push(const PlannedMove& move, Instant now);

  /// When the state changes next by itself: a block starts or ends. None when empty.
  std::optional<Instant> next_event() const;

  /// Starts or ends one block if that is due at `now`; the move that ended. Call until it returns none *and*
  /// next_event lies after `now`.
  std::optional<PlannedMove> advance(Instant now);

  /// Drops everything, where it stands; the machine stops at `position(now)`.
  void stop(Instant now);

  /// Where the machine is. With nothing to do: where the last move ended.
  MachinePosition position(Instant now) const;

  /// Sets the resting position (homing). Must be empty.
  void set_position(const MachinePosition& position) { position_ = position; }

  /// M201, M203, M204, M205: for moves still to come.
  MotionOptions& limits() { return options_; }

 private:
  struct Block {
    PlannedMove move;
    double length = 0;  ///< mm
    std::array<double, 4> direction{};
    double speed = 0;            ///< mm/s
    double acceleration = 0;     ///< mm/s^2
    double max_entry_speed = 0;  ///< mm/s
    double entry_speed = 0;      ///< mm/s
  };

  Block make_block(const PlannedMove& move) const;
  double junction_speed(const Block& before, const Block& after) const;
  double jerk_speed(const Block& before, const Block& after) const;
  double limit_by_axis(double acceleration, const std::array<double, 4>& direction) const;
  void look_ahead();
  std::size_t waiting_blocks() const { return blocks_.size() - (running_ ? 1 : 0); }

  MotionOptions options_;
  std::deque<Block> blocks_;  ///< the front one runs while `running_`
  std::optional<Trapezoid> running_;
  Instant started_{};     ///< of the running block
  Instant ends_{};        ///< of the running block
  Instant may_start_{};   ///< of the first block after a pause
  bool delayed_ = false;  ///< the front block waits for `may_start_` or for company
  MachinePosition position_{};
};

}  // namespace lamina::transport
