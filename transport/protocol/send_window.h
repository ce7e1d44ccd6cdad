#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "transport/protocol/engine_options.h"
#include "transport/protocol/outstanding_lines.h"
#include "transport/protocol/wire_clock.h"
#include "transport/time.h"

namespace lamina::transport {

/// How the next line may leave.
struct Leave {
  bool granted = false;
  bool without_end = false;  ///< its end is to be held back until it is alone on the way
  std::optional<Instant>
      opens{};  ///< not granted: when it will be if nothing else happens; none: not by time
};

/// Decides how much goes ahead of the printer's answers, from what the link and the printer have shown so
/// far.
///
/// The danger is the firmware's error flush. It falls upon what is arriving just then, and what it leaves of
/// a line runs as a command, unchecked, if it begins with a G. So a line that follows one that may be refused
/// leaves without its end: what is left of it can be erased before anything runs it. That costs nothing while
/// the answer comes before the wire has carried the line. Where it comes much later, whole lines go ahead, as
/// far apart as it takes the firmware to tell an error and to flush: each then arrives whole behind it.
class SendWindow {
 public:
  explicit SendWindow(const EngineOptions& options);

  /// A line's ok has come that long after its end was sent, or, where that is known, had left.
  void answered(Duration after);
  /// The printer has told how many blocks of its planner are free.
  void planner_free(int blocks);
  /// What was acknowledged last is a move: it shows whether the planner has room.
  void move_acknowledged();
  /// What was acknowledged last is none, and took its time: the planner may be empty as it should.
  void rests() { hungry_ = false; }

  void line_acknowledged();
  /// Lines have to be sent again, `lines_sent` into the conversation.
  void resend(LineNumber lines_sent);
  /// Something was odd: one line at a time for a while.
  void be_cautious() { cautious_left_ = options_.cautious_lines; }

  /// One line at a time, be it after a resend or for good.
  bool cautious() const;

  /// The last answer came as fast as the link allows: the planner had room.
  bool answered_at_once() const;

  /// Whether `command`, `bytes` of it, may follow what is on the way. `packed`: see meatpack.h; the flush
  /// cuts no packed line in front of a G.
  Leave leave(const OutstandingLines& on_the_way, std::size_t bytes, std::string_view command, bool packed,
              const WireClock& wire, Instant now) const;

 private:
  bool holds_ends(bool packed, const WireClock& wire) const;

  EngineOptions options_;
  /// From a line's end to its ok: the shortest of all so far, and the last one.
  std::optional<Duration> turnaround_;
  Duration last_turnaround_{};
  Duration usual_turnaround_{};  ///< of those that came at once
  std::optional<int> planner_free_;
  int planner_blocks_ = 0;  ///< the most that were ever free
  bool hungry_ = false;     ///< the planner was short of moves when it was last heard of
  LineNumber resends_ = 0;
  std::size_t cautious_left_ = 0;
  bool noisy_ = false;
};

}  // namespace lamina::transport
