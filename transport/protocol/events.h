#pragma once

#include <string>
#include <variant>

#include "transport/protocol/line_framing.h"
#include "transport/protocol/line_history.h"
#include "transport/protocol/reply.h"

namespace lamina::transport {

/// The printer has taken the greeting; lines will go out.
struct Connected {};

/// The printer was found as an earlier host left it, still counting: it wants line `next`, and has taken
/// every line before it.
struct Rejoined {
  LineNumber next = 0;
};

struct LineSent {
  NumberedLine line;
  bool again = false;  ///< sent before
};

/// The printer has run the line (a move: has put it in its planner).
struct LineAcknowledged {
  NumberedLine line;
  bool at_once = true;  ///< as fast as the link allows: the planner had a place for it
};

/// The printer wants line `number` next; the engine goes back to it.
struct ResendRequested {
  LineNumber number = 0;
  std::string reason;  ///< the firmware's words; may be empty
};

/// No word for too long, or words that do not fit together: the engine asks which lines arrived.
struct ProbeStarted {};

/// A reply that belongs to no line that was sent: an ok too many, or a command the firmware made up from the
/// tail of a line that its error flush had cut.
struct StrayReply {
  std::string text;
};

/// A line that the engine would not send, and why.
struct LineRefused {
  std::string command;
  LineOrigin origin = LineOrigin::kJob;
  std::string reason;
};

/// Everything else that the printer said, as understood.
struct ReplyReceived {
  Reply reply;
};

enum class EndReason {
  kClosed,           ///< by the owner
  kNotAPrinter,      ///< no answer to the greeting: wrong speed, or not a Marlin
  kHalted,           ///< the firmware has stopped with an error
  kRestarted,        ///< the firmware has started anew in the middle
  kNoAnswer,         ///< silent, also when asked
  kStuck,            ///< answers when asked, but acknowledges nothing
  kTooManyResends,   ///< keeps asking for the same line
  kHistoryExceeded,  ///< asks for a line that is no longer held
  kOutOfStep         ///< counts lines that were never sent
};

/// Nothing more will be sent. `next` is the first line that the printer is not known to have acknowledged.
struct Ended {
  EndReason reason = EndReason::kClosed;
  std::string detail;  ///< one line: what happened, and what to do
  LineNumber next = 0;
};

using Event = std::variant<Connected, Rejoined, LineSent, LineAcknowledged, ResendRequested, ProbeStarted,
                           StrayReply, LineRefused, ReplyReceived, Ended>;

}  // namespace lamina::transport
