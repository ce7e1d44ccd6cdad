#include "transport/session/command_session.h"

#include <utility>

#include "transport/protocol/line_stripper.h"

namespace lamina::transport {

namespace {

/// What a reply says, for those kinds that belong to an answer.
std::optional<std::string> text_of(const Reply& reply) {
  if (const auto* text = std::get_if<TextReply>(&reply)) return text->text;
  if (const auto* error = std::get_if<ErrorReply>(&reply)) return "Error:" + error->text;
  if (const auto* unknown = std::get_if<UnknownCommandReply>(&reply))
    return "Unknown command: \"" + unknown->command + '"';
  return std::nullopt;
}

}  // namespace

CommandSession::CommandSession(LineSource commands, EngineOptions options,
                               std::function<bool(const CommandAnswer&)> go_on)
    : commands_(std::move(commands)),
      engine_(options),
      go_on_(std::move(go_on)),
      one_by_one_(options.window.lines <= 1) {}

void CommandSession::start(Instant now) {
  engine_.connect(now);
}

void CommandSession::receive(std::string_view bytes, Instant now) {
  engine_.receive(bytes, now);
  observe(now);
}

void CommandSession::tick(Instant now) {
  engine_.tick(now);
  observe(now);
}

std::string CommandSession::take_output() {
  return engine_.take_output();
}

std::optional<Instant> CommandSession::deadline() const {
  return engine_.deadline();
}

void CommandSession::stop() {
  over_ = true;
}

std::vector<CommandAnswer> CommandSession::take_answers() {
  return std::exchange(answers_, {});
}

void CommandSession::observe(Instant now) {
  while (!finished_) {
    const std::vector<Event> events = engine_.take_events();
    for (const Event& event : events) observe(event);
    bool supplied = false;
    if (holds_ && engine_.all_acknowledged()) holds_ = false;
    if (!over_ && !holds_ && engine_.wants_line()) {
      if (const std::optional<std::string> line = commands_()) {
        const std::string command = strip_line(*line);
        holds_ = one_by_one_ || command.starts_with("M28");
        engine_.submit(command, LineOrigin::kJob);
      } else {
        over_ = true;
      }
      supplied = true;
    }
    if (over_ && !supplied && engine_.all_acknowledged()) {
      finished_ = true;
      engine_.close("done");
    }
    if (events.empty() && !supplied) return;
    engine_.tick(now);
  }
}

void CommandSession::observe(const Event& event) {
  if (const auto* received = std::get_if<ReplyReceived>(&event)) {
    if (std::optional<std::string> text = text_of(received->reply)) text_.push_back(*std::move(text));
  }
  if (const auto* acknowledged = std::get_if<LineAcknowledged>(&event)) {
    if (acknowledged->line.origin == LineOrigin::kJob) {
      answers_.push_back({acknowledged->line.command, std::exchange(text_, {})});
      if (go_on_ && !go_on_(answers_.back())) over_ = true;
    }
  }
  if (const auto* refused = std::get_if<LineRefused>(&event)) {
    failure_ = refused->command + ": " + refused->reason;
    over_ = finished_ = true;
    engine_.close(failure_);
  }
  if (std::holds_alternative<Connected>(event)) text_.clear();
  if (const auto* ended = std::get_if<Ended>(&event);
      ended != nullptr && ended->reason != EndReason::kClosed) {
    failure_ = ended->detail;
    finished_ = true;
  }
}

}  // namespace lamina::transport
