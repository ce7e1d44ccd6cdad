#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "transport/protocol/command_class.h"
#include "transport/protocol/line_framing.h"
#include "transport/time.h"

namespace lamina::transport {

/// A line on its way: sent, and not acknowledged.
struct OutstandingLine {
  std::optional<LineNumber> number;  ///< none for a line sent outside the numbering (M108)
  std::size_t bytes = 0;             ///< on the wire, with the line end
  CommandClass command_class = CommandClass::kQuick;
  bool reports_temperature = false;  ///< M105: its ok carries the temperatures, and no other ok does
  bool accepted = false;  ///< the printer has said that the line arrived whole; it may still be running
  bool held = false;      ///< its end has not been sent yet
  Instant ended{};        ///< when that was sent
  Instant left{};         ///< when that had gone over the wire
};

/// The lines on their way, oldest first, as far as the printer's replies tell. The firmware runs them in this
/// order, so an ok without a number belongs to the oldest.
class OutstandingLines {
 public:
  void add(const OutstandingLine& line) { lines_.push_back(line); }
  void clear() { lines_.clear(); }

  /// Takes the oldest out, for a plain ok. None if that was meant for something else: there is no line, its
  /// end has not been sent yet, or it is an M105, whose ok looks different.
  std::optional<OutstandingLine> acknowledge_oldest();

  /// Takes out everything up to and with line `number`, oldest first. Empty if that line is not here.
  std::vector<OutstandingLine> acknowledge_up_to(LineNumber number);

  /// Takes out everything up to and with the oldest M105. Empty if there is none.
  std::vector<OutstandingLine> acknowledge_temperature_report();

  /// The printer has every line below `next` and wants `next`: those are marked accepted, the rest (and what
  /// has no number) is gone.
  void keep_below(LineNumber next);

  /// Takes out what the printer has accepted and must have run by now. A blocking line, which may still be
  /// running, stays with what is behind it, unless `also_blocking`.
  std::vector<OutstandingLine> release_accepted(bool also_blocking);

  /// Forgets accepted questions (M105) whose answers are lost; lines before them stay.
  void forget_questions();

  bool empty() const { return lines_.empty(); }
  const OutstandingLine& oldest() const { return lines_.front(); }
  const std::deque<OutstandingLine>& lines() const { return lines_; }

  /// The last one's end is held back.
  bool last_is_held() const { return !lines_.empty() && lines_.back().held; }

  /// The end of the last one goes out at `now`, and has left at `left`.
  void release_last(Instant now, Instant left);

  /// Lines and bytes that may still be in the printer's receive buffer: those not known to be accepted.
  std::size_t unaccepted_lines() const;
  std::size_t unaccepted_bytes() const;

 private:
  std::vector<OutstandingLine> take(std::size_t count);

  std::deque<OutstandingLine> lines_;
};

}  // namespace lamina::transport
