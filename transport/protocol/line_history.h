#pragma once

#include <cstddef>
#include <deque>
#include <string>

#include "transport/protocol/line_framing.h"

namespace lamina::transport {

/// Who asked for a line.
enum class LineOrigin {
  kJob,       ///< the print
  kInjected,  ///< from the side, during the print: a console, a temperature poll
  kProtocol   ///< the engine itself
};

/// A line that has its number. The number stays with the command for good, so that the firmware's own
/// sequence check keeps a line that is sent again from running twice.
struct NumberedLine {
  LineNumber number = 0;
  std::string command;
  LineOrigin origin = LineOrigin::kJob;
};

/// The lines that the printer may still ask for: consecutive numbers, the newest at the end.
class LineHistory {
 public:
  /// Starts over: the next line gets `first`.
  void reset(LineNumber first);

  /// Gives `command` the next number and keeps it.
  const NumberedLine& append(std::string command, LineOrigin origin);

  /// The line of that number. It must be held: first() <= number < next().
  const NumberedLine& at(LineNumber number) const;

  /// Forgets lines below `number`.
  void forget_below(LineNumber number);

  LineNumber first() const { return first_; }
  LineNumber next() const { return first_ + static_cast<LineNumber>(lines_.size()); }

 private:
  std::deque<NumberedLine> lines_;
  LineNumber first_ = 1;
};

}  // namespace lamina::transport
