#include "transport/protocol/send_window.h"

#include <algorithm>

namespace lamina::transport {

namespace {

/// Of a numbered move, for the time that it takes.
constexpr double kUsualLineBytes = 30;

/// Of the longest error line, "Error:Line Number is not Last Line Number+1, Last Line: 123456", and some for
/// what the firmware does around it. A board without a transmit buffer flushes only when it has left.
constexpr double kErrorLineBytes = 72;

/// How much longer than the quickest answer one may take that came at once: in an adapter's packets some wait
/// for others.
constexpr int kPacketSpread = 3;
constexpr Duration kJitter = std::chrono::milliseconds(2);

/// Answers over which the usual one is taken.
constexpr int kAnswersOfUsual = 4;

/// Where the wire takes no time.
constexpr Duration kUnhurriedAnswer = std::chrono::microseconds(1500);

}  // namespace

SendWindow::SendWindow(const EngineOptions& options) : options_(options) {}

void SendWindow::answered(Duration after) {
  last_turnaround_ = after;
  if (!turnaround_) usual_turnaround_ = after;
  turnaround_ = std::min(turnaround_.value_or(after), after);
  if (answered_at_once()) usual_turnaround_ += (after - usual_turnaround_) / kAnswersOfUsual;
}

void SendWindow::planner_free(int blocks) {
  planner_free_ = blocks;
  planner_blocks_ = std::max(planner_blocks_, blocks);
}

void SendWindow::move_acknowledged() {
  hungry_ = planner_free_ ? 2 * *planner_free_ > planner_blocks_ : answered_at_once();
}

void SendWindow::line_acknowledged() {
  if (cautious_left_ > 0) --cautious_left_;
}

void SendWindow::resend(LineNumber lines_sent) {
  ++resends_;
  be_cautious();
  noisy_ = noisy_ || (resends_ >= static_cast<LineNumber>(options_.noisy_resends) &&
                      static_cast<double>(resends_) > options_.noisy_ratio * static_cast<double>(lines_sent));
}

bool SendWindow::cautious() const {
  return noisy_ || cautious_left_ > 0 || options_.window.lines <= 1;
}

bool SendWindow::answered_at_once() const {
  return turnaround_ && last_turnaround_ < kPacketSpread * *turnaround_ + kJitter;
}

Leave SendWindow::leave(const OutstandingLines& on_the_way, std::size_t bytes, std::string_view command,
                        bool packed, const WireClock& wire, Instant now) const {
  if (on_the_way.empty()) return {true};
  // Alone on the way, so that a cancel finds the command queue empty behind it.
  if (classify(command) == CommandClass::kBlocking) return {};
  if (on_the_way.last_is_held()) return {};
  const bool follows_unchecked = !on_the_way.oldest().accepted;
  const bool holds = holds_ends(packed, wire);
  const std::size_t lines = cautious() ? 1 : holds ? 2 : options_.window.lines;
  if (on_the_way.unaccepted_lines() >= lines || on_the_way.unaccepted_bytes() + bytes > options_.window.bytes)
    return {};
  const bool spaced = options_.window.hold_ends && !packed && follows_unchecked;
  const Instant opens = wire.free() + wire.time_of(kErrorLineBytes);
  if (!holds && spaced && now < opens) return {false, false, opens};
  return {true, holds && follows_unchecked, {}};
}

bool SendWindow::holds_ends(bool packed, const WireClock& wire) const {
  if (!options_.window.hold_ends || packed || cautious()) return false;
  const bool trusted = resends_ == 0;
  const Duration line_time = options_.baud > 0 ? wire.time_of(kUsualLineBytes) : kUnhurriedAnswer;
  return !hungry_ || !trusted || !turnaround_ ||
         usual_turnaround_ <= line_time + wire.time_of(kErrorLineBytes);
}

}  // namespace lamina::transport
