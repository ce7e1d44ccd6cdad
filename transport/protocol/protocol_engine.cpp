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
      if (now < due_ || ask_for_place(now)) return;
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
      encoder_.trouble();
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
  window_opens_.reset();
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
  encoder_.carried(line.bytes);
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

}  // namespace lamina::transport
