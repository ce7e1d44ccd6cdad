#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "transport/protocol/protocol_engine.h"
#include "transport/session/source_reader.h"
#include "transport/time.h"

namespace lamina::transport {

/// A command and what the printer said until it was done.
struct CommandAnswer {
  std::string command;
  std::vector<std::string> text;
};

/// Sends commands one after the other, numbered and checked, and collects what the printer says to each: the
/// conversation for everything that is not a print. Like the print job without I/O, clock or thread.
class CommandSession {
 public:
  /// Commands come from the source when there is room for them; at its end the session is over. With a window
  /// of one line, and behind M28 (whose failure would let what follows be run instead of written), the next
  /// command is taken only when the answer to the last has been looked at: `go_on` may end the session there.
  /// With a wider window text is given to the line that is acknowledged next.
  explicit CommandSession(LineSource commands, EngineOptions options = {},
                          std::function<bool(const CommandAnswer&)> go_on = {});

  void start(Instant now);
  void receive(std::string_view bytes, Instant now);
  void tick(Instant now);
  std::string take_output();
  std::optional<Instant> deadline() const;

  /// Nothing more is sent once the lines on their way are acknowledged.
  void stop();

  bool finished() const { return finished_; }
  /// Why it ended early, one line; empty otherwise.
  const std::string& failure() const { return failure_; }

  std::vector<CommandAnswer> take_answers();

 private:
  void observe(Instant now);
  void observe(const Event& event);

  LineSource commands_;
  ProtocolEngine engine_;
  std::vector<std::string> text_;
  std::vector<CommandAnswer> answers_;
  std::string failure_;
  std::function<bool(const CommandAnswer&)> go_on_;
  bool one_by_one_;
  bool holds_ = false;  ///< until the command under way is answered
  bool over_ = false;   ///< the source is
  bool finished_ = false;
};

}  // namespace lamina::transport
