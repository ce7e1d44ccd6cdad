// How the protocol engine begins, and how it gets back on its feet; protocol_engine.cpp has the rest.

#include <fmt/format.h>

#include "transport/protocol/lost_number.h"
#include "transport/protocol/meatpack.h"
#include "transport/protocol/protocol_engine.h"

namespace lamina::transport {

namespace {

/// Answers may be damaged, too.
constexpr int kPlaceQuestions = 6;

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
  ran_without_number_.reset();
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
  number_lost_ = number_lost_ || number < acknowledged_next_;
  // What was taken for their oks belonged to something else.
  for (LineNumber lost = number; lost < acknowledged_next_; ++lost)
    stray(fmt::format("ok of line {}, which had not arrived", lost));
  window_.resend(statistics_.lines_sent);
  encoder_.trouble();
  erase_wanted_ = erase_wanted_ || outstanding_.last_is_held();
  outstanding_.keep_below(number);
  cursor_ = number;
  last_number_certain_ = false;
  place_questions_left_ = kPlaceQuestions;
  place_confirms_ = false;
  sync_wanted_ = true;
  state_ = EngineState::kDraining;
  last_progress_ = now;
  due_ = now + options_.drain_quiet;
}

bool ProtocolEngine::ask_for_place(Instant now) {
  place_asked_ = false;
  const bool in_question = number_lost_ && place_questions_left_ > 0 && cursor_ < history_.next() &&
                           cursor_ != ran_without_number_ && !writes_file_ && outstanding_.empty() &&
                           tells_by_place(history_, cursor_);
  if (!in_question) return false;
  --place_questions_left_;
  if (!last_number_certain_) {
    start_probe(now, options_.drain_quiet);
    return true;
  }
  place_asked_ = true;
  const LineNumber last = cursor_ - 1;
  const std::string question = eraser() + encoder_.set_right(encoder_.encode(last, place_question(last)));
  put_out(question, now);
  outstanding_.add({last, question.size(), CommandClass::kQuick, false, false, false, now, wire_.free()});
  last_progress_ = last_sent_ = now;
  return true;
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
  encoder_.trouble();
  erase_wanted_ = erase_wanted_ || outstanding_.last_is_held();
  put_out(eraser() + encoder_.set_right("\n"), now);
  due_ = now + before_question;
}

void ProtocolEngine::conclude_rejoin(LineNumber wanted, Instant now) {
  rejoining_ = false;
  encoder_.restart();
  history_.reset(wanted);
  ran_without_number_.reset();
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
  // (Else it was said twice, and may have been said before the last line arrived.)
  const bool certain = announced_error_ && announced_error_->last_line == wanted - 1;
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
  last_number_certain_ = certain;
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
