#include "transport/protocol/protocol_engine.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include <fmt/format.h>

#include "transport/protocol/meatpack.h"

namespace lamina::transport {

namespace {

/// A number that cannot be next: Marlin answers with the number of the last line it took, and runs nothing.
constexpr LineNumber kImpossibleNumber = 2'000'000'000;

/// Its answer looks like no other ok, so it tells for certain that everything before it has run.
constexpr std::string_view kReportTemperatures = "M105";

}  // namespace

ProtocolEngine::ProtocolEngine(EngineOptions options)
    : options_(options), encoder_(options_), wire_(options_.baud), window_(options_) {}

void ProtocolEngine::connect(Instant now) {
  assert(state_ == EngineState::kIdle);
  state_ = EngineState::kWaitingForStart;
  due_ = now + options_.start_wait;
}

void ProtocolEngine::rejoin(Instant now) {
  connect(now);
  rejoining_ = true;
}

void ProtocolEngine::submit(std::string command, LineOrigin origin) {
  if (state_ == EngineState::kEnded || command.empty()) return;
  // The firmware looks for this text anywhere in a line, and takes a new line number from it.
  if (command.find("M110") != std::string::npos) {
    events_.emplace_back(LineRefused{std::move(command), origin, "it would change the line numbers"});
    return;
  }
  try {
    // Its number is not known yet; this leaves room for the lines that may come in between.
    frame_line(10 * (history_.next() + static_cast<LineNumber>(injected_.size() + job_.size())),
               wire_form(command, options_.form));
  } catch (const LineError& error) {
    events_.emplace_back(LineRefused{std::move(command), origin, error.what()});
    return;
  }
  (origin == LineOrigin::kJob ? job_ : injected_).push_back({std::move(command), origin});
}

void ProtocolEngine::send_urgent(std::string_view command, Instant now) {
  if (state_ == EngineState::kEnded) return;
  // The emergency parser sees the bytes as they come, the line reader what the unpacker makes of them: with
  // that switched off, both see the same.
  const std::string line = fmt::format("{}\n{}\n{}", encoder_.off(), command, encoder_.on());
  // Its line end also ends a line whose end is held back.
  if (outstanding_.last_is_held()) outstanding_.release_last(now, wire_.free());
  put_out(line, now);
  statistics_.bytes_sent += static_cast<LineNumber>(line.size());
  if (outstanding_.empty()) last_progress_ = now;
  outstanding_.add({std::nullopt, line.size(), CommandClass::kQuick, false, false, false, now, wire_.free()});
  last_sent_ = now;
}

void ProtocolEngine::drop_queued() {
  injected_.clear();
  job_.clear();
}

void ProtocolEngine::close(const std::string& why) {
  end(EndReason::kClosed, why);
}

void ProtocolEngine::receive(std::string_view bytes, Instant now) {
  wire_.received(bytes.size(), now);
  for (const std::string& line : reply_lines_.push(bytes)) {
    const Reply reply = parse_reply(line);
    events_.emplace_back(ReplyReceived{reply});
    handle(reply, now);
  }
  // Everything that has arrived is heard before anything is sent: a second, doubled ok in the same bytes
  // cannot then acknowledge a line that has not left yet.
  tick(now);
}

void ProtocolEngine::tick(Instant now) {
  switch (state_) {
    case EngineState::kIdle:
    case EngineState::kEnded:
      return;
    case EngineState::kWaitingForStart:
      if (now < due_) return;
      attempts_ = 0;
      if (rejoining_) {
        start_probe(now, options_.drain_quiet);
      } else {
        greet(now);
      }
      return;
    case EngineState::kGreeting:
      if (now < due_) return;
      if (attempts_ >= options_.greetings) {
        end(EndReason::kNotAPrinter,
            "no answer to the greeting; check that this is the printer's port and its speed (115200 or "
            "250000 baud)");
      } else {
        greet(now);
      }
      return;
    case EngineState::kSettling:
      if (now < due_) return;
      state_ = EngineState::kStreaming;
      resend_ok_until_.reset();
      announced_error_.reset();
      events_.emplace_back(Connected{});
      break;
    case EngineState::kDraining:
      if (older_lines_run()) {
        if (now >= last_progress_ + answer_timeout()) start_probe(now, options_.timeouts.probe);
        return;
      }
      if (now < due_) return;
      state_ = EngineState::kStreaming;
      break;
    case EngineState::kProbing:
      if (now < due_) return;
      if (attempts_ >= options_.silent_probes) {
        end(EndReason::kNoAnswer,
            "the printer does not answer any more; check its cable and power, the heaters may be on");
        return;
      }
      ++attempts_;
      question_sent_ = true;
      encoder_.doubt();
      // An earlier host may have left the unpacker on.
      if (rejoining_ && attempts_ % 2 == 0) put_out(meatpack::control(meatpack::kResetAll) + '\n', now);
      put_out(encoder_.set_right(encoder_.encode(kImpossibleNumber, kReportTemperatures)), now);
      // More patience each time: a firmware may be at something that lets nothing else in.
      due_ = now + options_.timeouts.probe * (1LL << std::min(attempts_ - 1, 10));
      return;
    case EngineState::kStreaming:
      break;
  }
  if (!outstanding_.empty() && now >= last_progress_ + answer_timeout()) {
    start_probe(now, options_.timeouts.probe);
    return;
  }
  if (settle_packing(now)) send_what_fits(now);
}

std::string ProtocolEngine::take_output() {
  return std::exchange(output_, {});
}

std::vector<Event> ProtocolEngine::take_events() {
  return std::exchange(events_, {});
}

std::optional<Instant> ProtocolEngine::deadline() const {
  switch (state_) {
    case EngineState::kIdle:
    case EngineState::kEnded:
      return std::nullopt;
    case EngineState::kStreaming:
      if (encoder_.asked()) return encoder_.request_due();
      if (outstanding_.empty()) return std::nullopt;
      return std::min(last_progress_ + answer_timeout(), window_opens_.value_or(Instant::max()));
    case EngineState::kDraining:
      return older_lines_run() ? last_progress_ + answer_timeout() : due_;
    default:
      return due_;
  }
}

bool ProtocolEngine::wants_line() const {
  return state_ == EngineState::kStreaming && injected_.empty() && job_.empty() && !sync_wanted_ &&
         cursor_ == history_.next();
}

bool ProtocolEngine::all_acknowledged() const {
  return wants_line() && outstanding_.empty();
}

void ProtocolEngine::acknowledge(const OutstandingLine& line) {
  if (!line.number) return;
  if (*line.number >= requested_) requests_ = 0;
  window_.line_acknowledged();
  // A line may be acknowledged, asked for again after all, and acknowledged again: it counts once.
  while (acknowledged_next_ <= *line.number) {
    ++statistics_.lines_acknowledged;
    events_.emplace_back(LineAcknowledged{history_.at(acknowledged_next_), window_.answered_at_once()});
    ++acknowledged_next_;
  }
  history_.forget_below(acknowledged_next_ - options_.history_lines);
}

bool ProtocolEngine::older_lines_run() const {
  return std::any_of(
      outstanding_.lines().begin(), outstanding_.lines().end(),
      [](const OutstandingLine& line) { return line.command_class != CommandClass::kBlocking; });
}

Duration ProtocolEngine::answer_timeout() const {
  const AnswerTimeouts& timeouts = options_.timeouts;
  const bool blocking =
      !outstanding_.empty() && outstanding_.oldest().command_class == CommandClass::kBlocking;
  if (blocking) return busy_lines_seen_ ? timeouts.blocking_busy_firmware : timeouts.blocking;
  return busy_lines_seen_ ? timeouts.busy_firmware : timeouts.silent_firmware;
}

Obstacle ProtocolEngine::obstacle() const {
  switch (state_) {
    case EngineState::kDraining:
    case EngineState::kProbing:
      return Obstacle::kRecovery;
    case EngineState::kStreaming:
      return all_acknowledged() ? Obstacle::kSource : Obstacle::kWire;
    default:
      return Obstacle::kNone;
  }
}

void ProtocolEngine::put_out(std::string_view bytes, Instant now) {
  output_ += bytes;
  wire_.sent(bytes.size(), now);
}

bool ProtocolEngine::settle_packing(Instant now) {
  if (!encoder_.negotiates(outstanding_.empty())) return true;
  const std::optional<std::string> request = encoder_.request(now);
  if (request) {
    put_out(*request, now);
  } else {
    // It cannot after all. What it has read instead of commands is a line begun.
    put_out(meatpack::control(meatpack::kDisable), now);
    start_probe(now, options_.drain_quiet);
  }
  return false;
}

void ProtocolEngine::release_end(Instant now) {
  if (!outstanding_.last_is_held() || outstanding_.lines().size() > 1) return;
  put_out("\n", now);
  outstanding_.release_last(now, wire_.free());
  last_progress_ = now;
}

std::string ProtocolEngine::eraser() {
  if (!std::exchange(erase_wanted_, false)) return {};
  return std::string(kMaxLineBytes, '\b') + '\n';
}

void ProtocolEngine::send_what_fits(Instant now) {
  window_opens_.reset();
  release_end(now);
  while (true) {
    const bool again = cursor_ < history_.next();
    // It would be in the file, and get no answer of its own.
    if (!again && writes_file_) sync_wanted_ = false;
    std::deque<QueuedLine>& queue = injected_.empty() ? job_ : injected_;
    if (!again && !sync_wanted_ && queue.empty()) return;
    const std::string_view command = again          ? history_.at(cursor_).command
                                     : sync_wanted_ ? kReportTemperatures
                                                    : std::string_view(queue.front().command);
    const std::string bytes = encoder_.encode(cursor_, command);
    const Leave how = leave(bytes.size(), command, now);
    if (!how.granted) {
      if (how.opens) window_opens_ = how.opens;
      return;
    }
    // A new line gets its number only when it goes out, so that an injected one can still overtake a queued
    // one.
    if (!again && sync_wanted_) {
      history_.append(std::string(command), LineOrigin::kProtocol);
      sync_wanted_ = false;
    } else if (!again) {
      history_.append(queue.front().command, queue.front().origin);
      queue.pop_front();
    }
    transmit(history_.at(cursor_), encoder_.set_right(bytes), how, again, now);
  }
}

Leave ProtocolEngine::leave(std::size_t bytes, std::string_view command, Instant now) const {
  // While a blocking line runs only the question whether it still does may follow.
  if (!outstanding_.empty()) {
    const OutstandingLine& oldest = outstanding_.oldest();
    if (oldest.command_class == CommandClass::kBlocking && !(oldest.accepted && sync_wanted_)) return {};
  }
  return window_.leave(outstanding_, bytes, command, encoder_.packs(), wire_, now);
}

void ProtocolEngine::transmit(const NumberedLine& line, const std::string& bytes, const Leave& leave,
                              bool again, Instant now) {
  if (outstanding_.empty()) last_progress_ = now;
  put_out(eraser(), now);
  put_out(leave.without_end ? std::string_view(bytes).substr(0, bytes.size() - 1) : bytes, now);
  outstanding_.add({line.number, bytes.size(), classify(line.command),
                    command_word(line.command) == kReportTemperatures, false, leave.without_end, now,
                    wire_.free()});
  const std::string_view word = command_word(line.command);
  if (word == "M28" || word == "M29") writes_file_ = word == "M28";
  statistics_.held_lines += leave.without_end ? 1 : 0;
  last_sent_ = now;
  cursor_ = line.number + 1;
  statistics_.bytes_sent += static_cast<LineNumber>(bytes.size());
  ++(again ? statistics_.lines_sent_again : statistics_.lines_sent);
  events_.emplace_back(LineSent{line, again});
}

}  // namespace lamina::transport
