// What the protocol engine makes of each reply of the printer; protocol_engine.cpp has the rest.

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "transport/protocol/lost_number.h"
#include "transport/protocol/protocol_engine.h"

namespace lamina::transport {

namespace {

std::string printable(std::string_view text) {
  std::string shown;
  for (const char c : text) shown += c >= ' ' && c <= '~' ? c : '?';
  return shown;
}

}  // namespace

void ProtocolEngine::handle(const Reply& reply, Instant now) {
  if (state_ == EngineState::kIdle || state_ == EngineState::kEnded) return;

  const bool is_ok = std::holds_alternative<OkReply>(reply);
  const bool is_resend = std::holds_alternative<ResendReply>(reply);
  // Error, Resend and ok come in one piece. An ok straight after the error means that the Resend line was
  // damaged.
  if (announced_error_ && is_ok && state_ != EngineState::kGreeting && state_ != EngineState::kSettling) {
    announced_error_.reset();
    if (state_ != EngineState::kProbing) start_probe(now, options_.drain_quiet);
    return;
  }

  if (const auto* ok = std::get_if<OkReply>(&reply)) handle_ok(*ok, now);
  if (const auto* resend = std::get_if<ResendReply>(&reply)) handle_resend(*resend, now);
  if (const auto* error = std::get_if<ErrorReply>(&reply)) handle_error(*error, now);
  if (const auto* unknown = std::get_if<UnknownCommandReply>(&reply)) handle_unknown_command(*unknown, now);
  if (std::holds_alternative<StartReply>(reply)) handle_start(now);
  if (std::holds_alternative<WaitReply>(reply)) handle_wait(now);
  if (const auto* place = std::get_if<PositionReply>(&reply)) handle_position(*place);
  if (const auto* capability = std::get_if<CapabilityReply>(&reply)) handle_capability(*capability);
  if (const auto* text = std::get_if<TextReply>(&reply)) encoder_.answered(text->text);
  if (std::holds_alternative<BusyReply>(reply)) {
    busy_lines_seen_ = true;
    last_progress_ = now;
    if (state_ == EngineState::kProbing) attempts_ = 0;
    // It prints from its card, or heats for an earlier host; it will get round to the greeting.
    if (state_ == EngineState::kGreeting) due_ = now + options_.greeting_wait;
  }
  if (const auto* temperatures = std::get_if<TemperatureReport>(&reply)) {
    // Inside M109 and M190 only; automatic reports flow whatever the command queue does.
    if (temperatures->waiting) last_progress_ = now;
  }
  if (is_resend) announced_error_.reset();
}

void ProtocolEngine::handle_ok(const OkReply& ok, Instant now) {
  if (state_ == EngineState::kWaitingForStart) return;
  if (state_ == EngineState::kGreeting) {
    if (resend_ok_until_) {
      resend_ok_until_.reset();
      return;
    }
    state_ = EngineState::kSettling;
    due_ = now + options_.greeting_quiet;
    return;
  }
  if (state_ == EngineState::kSettling) {
    due_ = now + options_.greeting_quiet;
    return;
  }

  const bool plain = !ok.number && !ok.temperatures;
  if (plain && resend_ok_until_) {
    const bool in_time = now <= *resend_ok_until_;
    resend_ok_until_.reset();
    if (in_time) {
      if (state_ == EngineState::kDraining) due_ = now + options_.drain_quiet;
      return;
    }
  }
  if (plain && stray_ok_follows_) {
    stray_ok_follows_ = false;
    return;
  }

  std::vector<OutstandingLine> acknowledged;
  if (ok.number) {
    numbered_oks_seen_ = true;
    acknowledged = outstanding_.acknowledge_up_to(*ok.number);
  } else if (ok.temperatures) {
    acknowledged = outstanding_.acknowledge_temperature_report();
  } else if (!outstanding_.empty() && !(numbered_oks_seen_ && outstanding_.oldest().number)) {
    // A firmware that numbers its oks leaves the number away only where the line had none. One that is here
    // before its line was there was said twice.
    early_ok_refused_ = wire_.too_early(outstanding_.oldest().left, now);
    if (const auto oldest = early_ok_refused_ ? std::nullopt : outstanding_.acknowledge_oldest())
      acknowledged.push_back(*oldest);
  }
  if (acknowledged.empty()) {
    number_lost_ = true;
    stray("ok");
    return;
  }
  const OutstandingLine& last = acknowledged.back();
  if (state_ == EngineState::kStreaming && !last.held)
    window_.answered(now - wire_.departure(last.ended, last.left));
  if (ok.planner_free) window_.planner_free(*ok.planner_free);
  if (last.command_class == CommandClass::kMotion) window_.move_acknowledged();
  if (last.command_class == CommandClass::kBlocking) window_.rests();
  for (const OutstandingLine& line : acknowledged) acknowledge(line);
  last_progress_ = now;
  fruitless_probes_ = 0;
  if (state_ == EngineState::kProbing && !rejoining_ && !question_sent_ && outstanding_.empty()) {
    // It was only late. Nothing has been asked yet, so no answer is under way. A host that rejoins has to
    // ask.
    state_ = EngineState::kDraining;
    due_ = now + options_.drain_quiet;
  }
}

void ProtocolEngine::handle_resend(const ResendReply& resend, Instant now) {
  resend_ok_until_ = now + options_.resend_ok_wait;
  const LineNumber wanted = resend.number;
  const bool consistent = announced_error_ && announced_error_->last_line == wanted - 1;
  switch (state_) {
    case EngineState::kGreeting:
      // The greeting itself was damaged, or glued to what lay in the firmware's buffer.
      due_ = now + options_.drain_quiet;
      return;
    case EngineState::kSettling:
      due_ = now + options_.greeting_quiet;
      return;
    case EngineState::kProbing:
      // Believed when the error line says the same, or when it is said twice.
      if (question_sent_ && (consistent || last_probe_answer_ == wanted)) {
        rejoining_ ? conclude_rejoin(wanted, now) : conclude_probe(wanted, now);
      } else {
        last_probe_answer_ = wanted;
      }
      return;
    case EngineState::kStreaming:
    case EngineState::kDraining:
      break;
    default:
      return;
  }
  if (state_ == EngineState::kDraining && wanted == cursor_) {
    // Lines behind the damaged one were still on the wire; each is refused in the same words.
    due_ = now + options_.drain_quiet;
    return;
  }
  const bool plausible = wanted >= acknowledged_next_ && wanted <= cursor_;
  if (!consistent && !plausible) {
    start_probe(now, options_.drain_quiet);
    return;
  }
  if (wanted == cursor_) {
    // Nothing was lost: an answer to a probe that came late, or noise between lines.
    stray(fmt::format("Resend: {}", wanted));
    return;
  }
  number_lost_ = number_lost_ || !announced_error_ || may_lack_number(announced_error_->text);
  events_.emplace_back(ResendRequested{wanted, announced_error_ ? printable(announced_error_->text) : ""});
  go_back_to(wanted, now);
}

void ProtocolEngine::handle_error(const ErrorReply& error, Instant now) {
  switch (error.severity) {
    case ErrorClass::kFatal:
      end(EndReason::kHalted,
          fmt::format("the printer has stopped: {}; switch it off and on when the cause is gone",
                      printable(error.text)));
      return;
    case ErrorClass::kProtocol:
      announced_error_ = error;
      if (state_ == EngineState::kDraining) due_ = now + options_.drain_quiet;
      return;
    case ErrorClass::kWarning:
      return;
  }
}

void ProtocolEngine::handle_unknown_command(const UnknownCommandReply& unknown, Instant now) {
  if (state_ == EngineState::kGreeting) {
    // A damaged greeting, run as something else.
    resend_ok_until_ = now + options_.resend_ok_wait;
    due_ = now + options_.drain_quiet;
    return;
  }
  if (state_ != EngineState::kStreaming && state_ != EngineState::kDraining &&
      state_ != EngineState::kProbing)
    return;
  // A question that noise has made something else of is ours, too.
  const bool ours =
      place_asked_ ||
      std::any_of(outstanding_.lines().begin(), outstanding_.lines().end(), [&](const OutstandingLine& line) {
        return line.number && wire_form(history_.at(*line.number).command, options_.form) == unknown.command;
      });
  if (ours) return;
  stray(unknown.command);
  if (!numbered_oks_seen_) stray_ok_follows_ = true;
  if (state_ == EngineState::kDraining) due_ = now + options_.drain_quiet;
  // Part of a line ran as a command, so some line did not arrive.
  if (state_ == EngineState::kStreaming) start_probe(now, options_.drain_quiet);
}

void ProtocolEngine::handle_start(Instant now) {
  const bool lines_ran = state_ == EngineState::kStreaming || state_ == EngineState::kDraining ||
                         (state_ == EngineState::kProbing && !rejoining_);
  if (lines_ran) {
    end(EndReason::kRestarted, kRestartedInTheMiddle);
    return;
  }
  rejoining_ = false;
  attempts_ = 0;
  state_ = EngineState::kWaitingForStart;
  due_ = now + options_.greeting_quiet;
}

void ProtocolEngine::handle_wait(Instant now) {
  // The firmware is idle. If a line was sent a while ago, either it or its ok is lost.
  const bool lost = state_ == EngineState::kStreaming && !outstanding_.empty() &&
                    now >= last_sent_ + options_.timeouts.probe;
  if (lost) start_probe(now, options_.drain_quiet);
}

void ProtocolEngine::handle_position(const PositionReply& place) {
  // Late, it may find that the line was there all the time.
  const bool still_open = state_ == EngineState::kDraining && cursor_ < history_.next();
  if (!std::exchange(place_asked_, false) || !still_open) return;
  // The ok behind it is that of the question.
  resend_ok_until_.reset();
  stray_ok_follows_ = false;
  const MoveTaken taken = move_taken(history_, cursor_, place);
  if (taken == MoveTaken::kNo) place_questions_left_ = 0;
  if (taken != MoveTaken::kYes || !std::exchange(place_confirms_, true)) return;
  place_questions_left_ = 0;
  ran_without_number_ = cursor_;
  stray(fmt::format("line {}, which had lost its number", cursor_));
}

void ProtocolEngine::handle_capability(const CapabilityReply& capability) {
  if (capability.name == "MEATPACK" && capability.present) encoder_.offered();
}

void ProtocolEngine::stray(const std::string& text) {
  encoder_.trouble();
  ++statistics_.stray_replies;
  events_.emplace_back(StrayReply{printable(text)});
}

}  // namespace lamina::transport
