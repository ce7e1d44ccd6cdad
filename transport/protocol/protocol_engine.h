#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "transport/protocol/engine_options.h"
#include "transport/protocol/events.h"
#include "transport/protocol/line_encoder.h"
#include "transport/protocol/line_history.h"
#include "transport/protocol/outstanding_lines.h"
#include "transport/protocol/reply.h"
#include "transport/protocol/send_window.h"
#include "transport/time.h"

namespace lamina::transport {

///     connect          start, or start_wait over       ok            quiet
///   kIdle --> kWaitingForStart ------> kGreeting --> kSettling --> kStreaming
///
///     kStreaming -- Resend --> kDraining -- quiet, older oks in --> kStreaming
///     kStreaming, kDraining -- silence, contradiction --> kProbing -- answer --> kDraining
///     any -- halted, start, silence for good, close --> kEnded
enum class EngineState {
  kIdle,
  kWaitingForStart,
  kGreeting,
  kSettling,
  kStreaming,
  kDraining,
  kProbing,
  kEnded
};

/// Why the printer gets no line just now.
enum class Obstacle {
  kNone,      ///< it is not to run any yet, or no more
  kWire,      ///< lines are on their way: the wire, or the printer itself, takes its time
  kRecovery,  ///< lines have to be sent again, or asked for
  kSource     ///< none was submitted
};

/// What has happened on the wire so far.
struct EngineStatistics {
  LineNumber lines_sent = 0;  ///< numbered lines, first time
  LineNumber lines_sent_again = 0;
  LineNumber lines_acknowledged = 0;
  LineNumber bytes_sent = 0;
  LineNumber resends = 0;  ///< requests that made the engine go back
  LineNumber probes = 0;
  LineNumber stray_replies = 0;
  LineNumber held_lines = 0;  ///< whose ends were held back
};

/// The host's side of Marlin's serial protocol, without I/O, clock or thread: bytes and the time go in, bytes
/// to send and events come out.
///
/// The life of a line:
///
///     submitted --> numbered, sent --> acknowledged (LineAcknowledged, once)
///                        ^   |
///                        +---+ the printer did not get it whole (ResendRequested, or the answer to a probe)
///
/// What is promised: lines run in the order submitted (injected ones before waiting job lines), each once. A
/// line keeps its number when it is sent again, so the firmware's sequence check guards against a second run.
/// With one line in flight this holds on any link whose damage the checksum can see, and where a line loses
/// just its number, which no checksum tells, for moves that show by their ends whether they have run
/// (lost_number.h). With a window, the firmware may run the tail of a line that its own error flush cut in
/// two (streaming to Marlin has no cure for that), which comes out as StrayReply. Whatever the printer does,
/// the engine ends or goes on; it waits without limit only for lines that it is not given.
///
/// Use: connect, then whenever bytes arrive `receive`, when `deadline` is reached `tick`; after each call
/// write `take_output` to the port and look at `take_events`. Keep it supplied while `wants_line`.
class ProtocolEngine {
 public:
  explicit ProtocolEngine(EngineOptions options = {});

  /// Begins: waits for `start`, then greets (M110). Only in kIdle.
  void connect(Instant now);

  /// Begins where an earlier host broke off, without a new M110: asks which line is next (see Rejoined). A
  /// printer that says `start` has forgotten; it is greeted as by `connect`. Only in kIdle.
  void rejoin(Instant now);

  /// Queues a stripped command (see strip_line). It goes out with the next receive or tick that has room for
  /// it. A line that is too long, or that would disturb the numbering (M110), is dropped with a LineRefused.
  void submit(std::string command, LineOrigin origin);

  /// Sends `command` at once, unnumbered, past the queue and the window: M108, M112, M410. The line end in
  /// front of it keeps a half-sent line from hiding it.
  void send_urgent(std::string_view command, Instant now);

  /// Drops every queued line that was not sent yet.
  void drop_queued();

  /// Ends here; nothing more is sent.
  void close(const std::string& why);

  /// Takes bytes from the printer.
  void receive(std::string_view bytes, Instant now);

  /// Does what is due at `now`.
  void tick(Instant now);

  /// Bytes to write, in order; empty when there are none.
  std::string take_output();

  std::vector<Event> take_events();

  /// When `tick` is due next, if nothing arrives before. None: never.
  std::optional<Instant> deadline() const;

  EngineState state() const { return state_; }

  /// Lines are running and none is queued: time to submit.
  bool wants_line() const;

  /// Connected, and every submitted line is acknowledged.
  bool all_acknowledged() const;

  /// Lines in flight that are not acknowledged, oldest first.
  const std::deque<OutstandingLine>& outstanding() const { return outstanding_.lines(); }

  /// The number that the next new line will get.
  LineNumber next_number() const { return history_.next(); }

  /// One line at a time is allowed now, be it after a resend or for good.
  bool cautious() const { return window_.cautious(); }

  /// Lines go out packed (MeatPack).
  bool packs() const { return encoder_.packs(); }

  /// What keeps the printer from having more lines.
  Obstacle obstacle() const;

  const EngineStatistics& statistics() const { return statistics_; }

 private:
  static constexpr const char* kRestartedInTheMiddle =
      "the printer has restarted in the middle of the print; its heaters are off and its position is lost";

  /// Its answer looks like no other ok, so it tells for certain that everything before it has run.
  static constexpr std::string_view kReportTemperatures = "M105";

  struct QueuedLine {
    std::string command;
    LineOrigin origin;
  };

  void handle(const Reply& reply, Instant now);
  void handle_ok(const OkReply& ok, Instant now);
  void handle_resend(const ResendReply& resend, Instant now);
  void handle_error(const ErrorReply& error, Instant now);
  void handle_unknown_command(const UnknownCommandReply& unknown, Instant now);
  void handle_start(Instant now);
  void handle_wait(Instant now);
  void handle_position(const PositionReply& place);
  void handle_capability(const CapabilityReply& capability);

  void greet(Instant now);
  void go_back_to(LineNumber number, Instant now);
  void start_probe(Instant now, Duration before_question);
  void conclude_probe(LineNumber wanted, Instant now);
  void conclude_rejoin(LineNumber wanted, Instant now);
  void end(EndReason reason, std::string detail);

  /// Asks where the printer is, or first which line is next, if that can tell whether it has run that line
  /// without its number (lost_number.h).
  bool ask_for_place(Instant now);

  /// Sees to it that lines are packed where they can be. False while nothing else may be sent.
  bool settle_packing(Instant now);

  /// Puts bytes that are no line of the print on the wire.
  void put_out(std::string_view bytes, Instant now);
  /// Sends the end that was held back, when its time has come.
  void release_end(Instant now);
  /// What takes a held line, or what is left of it, out of the printer's line buffer.
  std::string eraser();

  void send_what_fits(Instant now);
  /// Whether a line may go, now or without its end.
  Leave leave(std::size_t bytes, std::string_view command, Instant now) const;
  void transmit(const NumberedLine& line, const std::string& bytes, const Leave& leave, bool again,
                Instant now);
  void acknowledge(const OutstandingLine& line);
  void stray(const std::string& text);
  /// What goes out as line `cursor_`, if anything is to.
  std::optional<std::string_view> next_command() const;
  /// Lines that the printer has and that were not yet acknowledged; a blocking one may take minutes and is
  /// not counted.
  bool older_lines_run() const;
  Duration answer_timeout() const;

  EngineOptions options_;
  EngineState state_ = EngineState::kIdle;
  ReplyLines reply_lines_;
  LineHistory history_;
  OutstandingLines outstanding_;
  LineEncoder encoder_;
  WireClock wire_;
  SendWindow window_;
  std::deque<QueuedLine> injected_;
  std::deque<QueuedLine> job_;
  std::string output_;
  std::vector<Event> events_;
  EngineStatistics statistics_;

  /// The line that goes out next: below history_.next() while lines are sent again.
  LineNumber cursor_ = 1;
  /// The first line for which no LineAcknowledged was given.
  LineNumber acknowledged_next_ = 1;

  /// Start-up, drain, and the next step of a probe: when it is due.
  Instant due_{};
  /// The last sign that the oldest outstanding line is being worked on.
  Instant last_progress_{};
  Instant last_sent_{};
  int attempts_ = 0;            ///< greetings or probe questions sent
  bool rejoining_ = false;      ///< the next probe's answer tells where to begin
  bool question_sent_ = false;  ///< a probe's question, not only its newline
  int fruitless_probes_ = 0;
  std::optional<LineNumber> last_probe_answer_;

  /// Set by the Error line, used up by the Resend line that follows it.
  std::optional<ErrorReply> announced_error_;
  /// The next plain ok belongs to a Resend (until then).
  std::optional<Instant> resend_ok_until_;
  /// The next plain ok belongs to a command that was never sent.
  bool stray_ok_follows_ = false;
  /// The last plain ok was not believed, as it came too early for any line.
  bool early_ok_refused_ = false;

  /// An ok has come that fits no line, or an error that goes with it: a line may have run without its number
  /// (lost_number.h).
  bool number_lost_ = false;
  bool last_number_certain_ = false;  ///< cursor_ is the line that the printer wants
  int place_questions_left_ = 0;
  bool place_asked_ = false;
  bool place_confirms_ = false;  ///< said once that it has run the line; it has to say so again
  std::optional<LineNumber> ran_without_number_;

  LineNumber requested_ = -1;  ///< the line asked for last
  int requests_ = 0;           ///< how often in a row
  bool busy_lines_seen_ = false;
  bool numbered_oks_seen_ = false;
  bool sync_wanted_ = false;  ///< an M105 is to go out before any new line
  bool writes_file_ = false;  ///< between M28 and M29 lines are written to the card, not run

  std::optional<Instant> window_opens_;  ///< for the line that waits
  bool erase_wanted_ = false;            ///< a line without an end may lie in the printer's line buffer
};

}  // namespace lamina::transport
