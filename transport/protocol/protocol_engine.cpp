#include "transport/protocol/protocol_engine.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include <fmt/format.h>

#include "transport/protocol/meatpack.h"
#include "transport/protocol/packable_form.h"

namespace lamina::transport {

namespace {

/// A number that cannot be next: Marlin answers with the number of the last line it took, and runs nothing.
constexpr LineNumber kImpossibleNumber = 2'000'000'000;

/// Of a numbered move, for the time that it takes.
constexpr double kUsualLineBytes = 30;

/// Number and checksum of a line, with room for numbers up to a thousand billion.
constexpr std::size_t kMostFrameBytes = 18;

/// Where the wire takes no time.
constexpr Duration kUnhurriedAnswer = std::chrono::microseconds(1500);

/// More lines than oks can be mistaken for those of others.
constexpr LineNumber kPlainlyRun = 8;

/// Its answer looks like no other ok, so it tells for certain that everything before it has run.
constexpr const char* kReportTemperatures = "M105";

}  // namespace

ProtocolEngine::ProtocolEngine(EngineOptions options) : options_(options) {}

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
  std::string line = fmt::format("\n{}\n", command);
  // The emergency parser sees the bytes as they come, the line reader what the unpacker makes of them: with
  // that switched off, both see the same.
  if (packing_ == Packing::kOn)
    line = meatpack::control(meatpack::kDisable) + line + meatpack::start(!options_.form.blanks);
  // Its line end also ends a line whose end is held back.
  if (outstanding_.last_is_held()) outstanding_.release_last(now);
  output_ += line;
  statistics_.bytes_sent += static_cast<LineNumber>(line.size());
  if (outstanding_.empty()) last_progress_ = now;
  outstanding_.add({std::nullopt, line.size(), CommandClass::kQuick, false, false, false, now});
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
  account_for_time(now);
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
  account_for_time(now);
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
      unpacker_in_doubt_ = true;
      // An earlier host may have left the unpacker on.
      if (rejoining_ && attempts_ % 2 == 0) output_ += meatpack::control(meatpack::kResetAll) + '\n';
      output_ += resynchronized(encode(kImpossibleNumber, kReportTemperatures));
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
      if (packing_ == Packing::kAsked) return packing_due_;
      if (outstanding_.empty()) return std::nullopt;
      return last_progress_ + answer_timeout();
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

bool ProtocolEngine::cautious() const {
  return noisy_ || cautious_left_ > 0 || options_.window.lines <= 1;
}

void ProtocolEngine::greet(Instant now) {
  ++attempts_;
  state_ = EngineState::kGreeting;
  packing_ = Packing::kOff;
  packing_requests_ = 0;
  // A host that was killed may have left the unpacker on. Other firmwares make an unknown command of this.
  if (attempts_ % 2 == 0) output_ += meatpack::control(meatpack::kResetAll);
  // The line end first: a half line of the boot loader's or of another program's would swallow the greeting.
  output_ += '\n';
  output_ += frame_line(0, "M110 N0");
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
  be_cautious();
  erase_wanted_ = erase_wanted_ || outstanding_.last_is_held();
  outstanding_.keep_below(number);
  cursor_ = number;
  sync_wanted_ = true;
  unpacker_in_doubt_ = true;
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
  unpacker_in_doubt_ = true;
  erase_wanted_ = erase_wanted_ || outstanding_.last_is_held();
  output_ += eraser() + resynchronized(packed("\n"));
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
    be_cautious();
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
  if (packing_ == Packing::kOn) output_ += meatpack::control(meatpack::kDisable);
  packing_ = Packing::kOff;
  events_.emplace_back(Ended{reason, std::move(detail), acknowledged_next_});
}

void ProtocolEngine::acknowledge(const OutstandingLine& line) {
  if (!line.number) return;
  if (*line.number >= requested_) requests_ = 0;
  if (cautious_left_ > 0) --cautious_left_;
  // A line may be acknowledged, asked for again after all, and acknowledged again: it counts once.
  while (acknowledged_next_ <= *line.number) {
    ++statistics_.lines_acknowledged;
    events_.emplace_back(LineAcknowledged{history_.at(acknowledged_next_)});
    ++acknowledged_next_;
  }
  history_.forget_below(acknowledged_next_ - options_.history_lines);
}

void ProtocolEngine::be_cautious() {
  cautious_left_ = options_.cautious_lines;
  const auto resends = static_cast<double>(statistics_.resends);
  noisy_ = noisy_ || (statistics_.resends >= static_cast<LineNumber>(options_.noisy_resends) &&
                      resends > options_.noisy_ratio * static_cast<double>(statistics_.lines_sent));
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

bool ProtocolEngine::settle_packing(Instant now) {
  switch (packing_) {
    case Packing::kOff:
    case Packing::kOn:
      return true;
    case Packing::kOffered:
      if (!outstanding_.empty()) return true;
      packing_ = Packing::kAsked;
      packing_requests_ = 0;
      packing_due_ = now;
      [[fallthrough]];
    case Packing::kAsked:
      if (now < packing_due_) return false;
      if (packing_requests_ == options_.meatpack_requests) {
        // It cannot after all. What it has read instead of commands is a line begun.
        packing_ = Packing::kOff;
        output_ += meatpack::control(meatpack::kDisable);
        start_probe(now, options_.drain_quiet);
        return false;
      }
      ++packing_requests_;
      packing_due_ = now + options_.meatpack_wait;
      output_ += meatpack::start(!options_.form.blanks);
      return false;
  }
  return true;
}

std::string ProtocolEngine::encode(LineNumber number, std::string_view command) const {
  const bool packs = packing_ == Packing::kOn;
  const LineFrame frame{options_.form.blanks, packs && !options_.form.blanks};
  std::string text = wire_form(command, options_.form);
  if (frame.even_digits) {
    // The frame puts an odd count of characters before it.
    std::string packable = packable_form(text, 1);
    if (packable.size() + kMostFrameBytes <= kMaxLineBytes) text = std::move(packable);
  }
  return packed(frame_line(number, text, frame));
}

std::string ProtocolEngine::packed(std::string bytes) const {
  return packing_ == Packing::kOn ? meatpack::pack(bytes, !options_.form.blanks) : bytes;
}

std::string ProtocolEngine::resynchronized(std::string bytes) {
  const bool in_doubt = std::exchange(unpacker_in_doubt_, false);
  if (packing_ != Packing::kOn || !in_doubt) return bytes;
  return meatpack::start(!options_.form.blanks) + bytes;
}

StarvationCause ProtocolEngine::in_the_way() const {
  switch (state_) {
    case EngineState::kDraining:
    case EngineState::kProbing:
      return StarvationCause::kRecovery;
    case EngineState::kStreaming:
      return all_acknowledged() ? StarvationCause::kSource : StarvationCause::kWire;
    default:
      return StarvationCause::kNone;
  }
}

void ProtocolEngine::account_for_time(Instant now) {
  starvation_.advance(now, in_the_way());
  statistics_.starved = starvation_.total();
}

bool ProtocolEngine::holds_ends() const {
  if (!options_.window.hold_ends || packing_ == Packing::kOn || cautious() || !turnaround_) return false;
  const Duration line_time =
      options_.baud > 0 ? from_seconds(kUsualLineBytes * 10 / options_.baud) : kUnhurriedAnswer;
  const bool hungry = starvation_.last_planner_free() ? starvation_.hungry() : answered_at_once();
  const bool trusted = statistics_.resends == 0;
  return !hungry || !trusted || *turnaround_ <= line_time;
}

bool ProtocolEngine::answered_at_once() const {
  return turnaround_ && last_turnaround_ < 2 * *turnaround_;
}

void ProtocolEngine::release_end(Instant now) {
  if (!outstanding_.last_is_held() || outstanding_.lines().size() > 1) return;
  outstanding_.release_last(now);
  output_ += '\n';
  last_progress_ = now;
}

std::string ProtocolEngine::eraser() {
  if (!std::exchange(erase_wanted_, false)) return {};
  return std::string(kMaxLineBytes, '\b') + '\n';
}

void ProtocolEngine::send_what_fits(Instant now) {
  release_end(now);
  while (true) {
    if (cursor_ < history_.next()) {
      const NumberedLine& line = history_.at(cursor_);
      const std::string encoded = encode(line.number, line.command);
      if (!fits(encoded.size(), line.command)) return;
      transmit(line, resynchronized(encoded), true, now);
      continue;
    }
    std::deque<QueuedLine>& queue = injected_.empty() ? job_ : injected_;
    if (!sync_wanted_ && queue.empty()) return;
    // A new line gets its number only when it goes out, so that an injected one can still overtake a queued
    // one.
    const QueuedLine line =
        sync_wanted_ ? QueuedLine{kReportTemperatures, LineOrigin::kProtocol} : queue.front();
    const std::string encoded = encode(cursor_, line.command);
    if (!fits(encoded.size(), line.command)) return;
    if (sync_wanted_) {
      sync_wanted_ = false;
    } else {
      queue.pop_front();
    }
    transmit(history_.append(line.command, line.origin), resynchronized(encoded), false, now);
  }
}

bool ProtocolEngine::fits(std::size_t bytes, std::string_view command) const {
  if (outstanding_.empty()) return true;
  // Alone on the way, so that a cancel finds the command queue empty behind it.
  if (classify(command) == CommandClass::kBlocking) return false;
  // While it runs only the question whether it still does may follow.
  const OutstandingLine& oldest = outstanding_.oldest();
  if (oldest.command_class == CommandClass::kBlocking && !(oldest.accepted && sync_wanted_)) return false;
  if (outstanding_.last_is_held()) return false;
  const std::size_t lines = cautious() ? 1 : holds_ends() ? 2 : options_.window.lines;
  return outstanding_.unaccepted_lines() < lines &&
         outstanding_.unaccepted_bytes() + bytes <= options_.window.bytes;
}

void ProtocolEngine::transmit(const NumberedLine& line, const std::string& bytes, bool again, Instant now) {
  const bool held = !outstanding_.empty() && !outstanding_.oldest().accepted && holds_ends();
  if (outstanding_.empty()) last_progress_ = now;
  outstanding_.add({line.number, bytes.size(), classify(line.command),
                    command_word(line.command) == kReportTemperatures, false, held, now});
  output_ += eraser();
  output_ += held ? bytes.substr(0, bytes.size() - 1) : bytes;
  statistics_.held_lines += held ? 1 : 0;
  last_sent_ = now;
  cursor_ = line.number + 1;
  statistics_.bytes_sent += static_cast<LineNumber>(bytes.size());
  ++(again ? statistics_.lines_sent_again : statistics_.lines_sent);
  events_.emplace_back(LineSent{line, again});
}

}  // namespace lamina::transport
