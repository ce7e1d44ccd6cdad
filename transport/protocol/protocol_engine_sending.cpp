// What the protocol engine sends, when and in which form; protocol_engine.cpp has the rest.

#include <utility>

#include <fmt/format.h>

#include "transport/protocol/meatpack.h"
#include "transport/protocol/protocol_engine.h"

namespace lamina::transport {

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

void ProtocolEngine::put_out(std::string_view bytes, Instant now) {
  output_ += bytes;
  wire_.sent(bytes.size(), now);
}

bool ProtocolEngine::settle_packing(Instant now) {
  if (!encoder_.negotiates()) return true;
  if (!encoder_.asked() && !outstanding_.empty()) {
    release_end(now);
    return false;
  }
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
  release_end(now);
  while (true) {
    const bool again = cursor_ < history_.next();
    // It would be in the file, and get no answer of its own.
    if (!again && writes_file_) sync_wanted_ = false;
    const std::optional<std::string_view> command = next_command();
    if (!command) return;
    const std::string bytes = encoder_.encode(cursor_, *command);
    const Leave how = leave(bytes.size(), *command, now);
    if (!how.granted) {
      if (how.opens) window_opens_ = how.opens;
      return;
    }
    // A new line gets its number only when it goes out, so that an injected one can still overtake a queued
    // one.
    if (!again && sync_wanted_) {
      history_.append(std::string(*command), LineOrigin::kProtocol);
      sync_wanted_ = false;
    } else if (!again) {
      std::deque<QueuedLine>& queue = injected_.empty() ? job_ : injected_;
      history_.append(std::move(queue.front().command), queue.front().origin);
      queue.pop_front();
    }
    NumberedLine line = history_.at(cursor_);
    if (line.number == ran_without_number_) line.command = kReportTemperatures;
    transmit(line, encoder_.set_right(bytes), how, again, now);
  }
}

std::optional<std::string_view> ProtocolEngine::next_command() const {
  if (cursor_ < history_.next())
    return cursor_ == ran_without_number_ ? kReportTemperatures : history_.at(cursor_).command;
  if (sync_wanted_) return kReportTemperatures;
  const std::deque<QueuedLine>& queue = injected_.empty() ? job_ : injected_;
  if (queue.empty()) return std::nullopt;
  return queue.front().command;
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
  if (again) number_lost_ = false;
  cursor_ = line.number + 1;
  statistics_.bytes_sent += static_cast<LineNumber>(bytes.size());
  ++(again ? statistics_.lines_sent_again : statistics_.lines_sent);
  events_.emplace_back(LineSent{line, again});
}

}  // namespace lamina::transport
