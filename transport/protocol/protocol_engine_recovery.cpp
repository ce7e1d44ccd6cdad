// How the protocol engine begins, and how it gets back on its feet; protocol_engine.cpp has the rest.

#include <fmt/format.h>

#include "transport/protocol/meatpack.h"
#include "transport/protocol/protocol_engine.h"

namespace lamina::transport {

namespace {

/// More lines than oks can be mistaken for those of others.
constexpr LineNumber kPlainlyRun = 8;

}  // namespace

void ProtocolEngine::greet(Instant now) {
  ++attempts_;
  state_ = EngineState::kGreeting;
  encoder_.restart();
  // A host that was killed may have left the unpacker on. Other firmwares make an unknown command of this.
  if (attempts_ % 2 == 0) put_out(meatpack::control(meatpack::kResetAll), now);
  // The line end first: a half line of the boot loader's or of another program's would swallow the greeting.
  put_out("\n" + frame_line(0, "M110 N0"), now);
  due_ = now + options_.greeting_wait;
  history_.reset(1);
  outstanding_.clear();
  cursor_ = 1;
  acknowledged_next_ = 1;
}

void ProtocolEngine::go_back_to(LineNumber number, Instant now) {
  // It counts from the beginning: `start` was lost on the way.
  if (number == 1 && acknowledged_next_ > 1 + kPlainlyRun) {
    end(EndReason::kRestarted, kRestartedInTheMiddle);
    return;
  }
  if (number > history_.next()) {
    end(EndReason::kOutOfStep, fmt::format("the printer asks for line {}, which was never sent", number));
    return;
  }
  if (number < history_.first()) {
    end(EndReason::kHistoryExceeded,
        fmt::format("the printer asks for line {}, which is no longer held (first held: {})", number,
                    history_.first()));
    return;
  }
  ++statistics_.resends;
  requests_ = number == requested_ ? requests_ + 1 : 1;
  requested_ = number;
  if (requests_ > options_.resends_of_one_line) {
    end(EndReason::kTooManyResends,
        fmt::format(
            "line {} was asked for {} times in a row; check the cable, keep it away from the motor wires",
            number, requests_));
    return;
  }
  // What was taken for their oks belonged to something else.
  for (LineNumber lost = number; lost < acknowledged_next_; ++lost)
    stray(fmt::format("ok of line {}, which had not arrived", lost));
  window_.resend(statistics_.lines_sent);
  encoder_.damaged();
  encoder_.doubt();
  erase_wanted_ = erase_wanted_ || outstanding_.last_is_held();
  outstanding_.keep_below(number);
  cursor_ = number;
  sync_wanted_ = true;
  state_ = EngineState::kDraining;
  last_progress_ = now;
  due_ = now + options_.drain_quiet;
}

void ProtocolEngine::start_probe(Instant now, Duration before_question) {
  if (++fruitless_probes_ > options_.fruitless_probes) {
    end(EndReason::kStuck, "the printer answers, but acknowledges no line any more; look at its display");
    return;
  }
  ++statistics_.probes;
  events_.emplace_back(ProbeStarted{});
  state_ = EngineState::kProbing;
  attempts_ = 0;
  question_sent_ = false;
  last_probe_answer_.reset();
  announced_error_.reset();
  // Ends a line whose own end was lost. Without one, the firmware makes nothing of it.
  encoder_.doubt();
  erase_wanted_ = erase_wanted_ || outstanding_.last_is_held();
  put_out(eraser() + encoder_.set_right(encoder_.packed("\n")), now);
  due_ = now + before_question;
}

void ProtocolEngine::conclude_rejoin(LineNumber wanted, Instant now) {
  rejoining_ = false;
  history_.reset(wanted);
  cursor_ = wanted;
  acknowledged_next_ = wanted;
  outstanding_.clear();
  fruitless_probes_ = 0;
  // Older lines may still run; their oks are over when this question is answered.
  sync_wanted_ = true;
  state_ = EngineState::kDraining;
  due_ = now + options_.drain_quiet;
  events_.emplace_back(Rejoined{wanted});
}

void ProtocolEngine::conclude_probe(LineNumber wanted, Instant now) {
  const bool lost_lines = wanted < cursor_;
  if (lost_lines || wanted > history_.next()) {
    events_.emplace_back(ResendRequested{wanted, "found by asking"});
    go_back_to(wanted, now);
    if (state_ == EngineState::kEnded) return;
  } else {
    if (early_ok_refused_) wire_.distrust();
    window_.be_cautious();
    outstanding_.keep_below(wanted);
    cursor_ = wanted;
    sync_wanted_ = true;
    state_ = EngineState::kDraining;
    due_ = now + options_.drain_quiet;
  }
  // All of these arrived, and after so long a silence only their oks can be missing. A blocking command may
  // still run: the M105 behind it will tell, if lines that were sent before do not have to go first.
  const bool question_is_next = cursor_ == history_.next();
  for (const OutstandingLine& line : outstanding_.release_accepted(!question_is_next)) acknowledge(line);
  outstanding_.forget_questions();
  last_progress_ = now;
}

void ProtocolEngine::end(EndReason reason, std::string detail) {
  if (state_ == EngineState::kEnded) return;
  state_ = EngineState::kEnded;
  erase_wanted_ = erase_wanted_ || outstanding_.last_is_held();
  output_ += eraser();
  // The next host begins with plain lines.
  output_ += encoder_.off();
  encoder_.restart();
  events_.emplace_back(Ended{reason, std::move(detail), acknowledged_next_});
}

}  // namespace lamina::transport
