#include "transport/session/print_job.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "transport/protocol/line_stripper.h"

namespace lamina::transport {

namespace {

/// How soon an empty source is looked at again.
constexpr Duration kLookAgain = std::chrono::milliseconds(20);

void keep_earliest(std::optional<Instant>& earliest, std::optional<Instant> candidate) {
  if (candidate && (!earliest || *candidate < *earliest)) earliest = candidate;
}

}  // namespace

PrintJob::PrintJob(LineSource source, PrintJobOptions options)
    : options_(std::move(options)), reader_(std::move(source)), engine_(options_.engine) {}

void PrintJob::receive(std::string_view bytes, Instant now) {
  account_for_time(now);
  engine_.receive(bytes, now);
  observe(now);
}

void PrintJob::tick(Instant now) {
  account_for_time(now);
  engine_.tick(now);
  if (progress_.phase == JobPhase::kPaused) cool_down_parked(now);
  if (progress_.phase == JobPhase::kCancelling) break_waits(now);
  observe(now);
}

std::string PrintJob::take_output() {
  return engine_.take_output() + std::exchange(last_words_, {});
}

std::vector<Event> PrintJob::take_events() {
  return std::exchange(events_, {});
}

bool PrintJob::take_discard() {
  return std::exchange(discard_, false);
}

std::optional<Instant> PrintJob::deadline() const {
  if (finished()) return std::nullopt;
  std::optional<Instant> due = engine_.deadline();
  // Elsewhere it is not asked, and an answer that is late may still have set the time for the next question.
  const bool asks = progress_.phase == JobPhase::kPrinting || progress_.phase == JobPhase::kPausing ||
                    progress_.phase == JobPhase::kPaused;
  if (asks) keep_earliest(due, poll_due_);
  keep_earliest(due, look_again_);
  if (progress_.phase == JobPhase::kCancelling) keep_earliest(due, break_due_);
  if (progress_.phase == JobPhase::kPaused) {
    const MachineState& printer = log_.printer();
    const bool nozzle = std::any_of(printer.nozzles.begin(), printer.nozzles.end(),
                                    [](const auto& target) { return target.second > 0; });
    if (nozzle) keep_earliest(due, parked_since_ + options_.park.keep_nozzle_hot);
    if (printer.bed > 0) keep_earliest(due, parked_since_ + options_.park.keep_bed_hot);
  }
  return due;
}

std::optional<std::string> PrintJob::inject(std::string_view text) {
  const std::string command = strip_line(text);
  if (command.empty()) return std::nullopt;
  const JobPhase phase = progress_.phase;
  if (phase != JobPhase::kPrinting && phase != JobPhase::kPausing && phase != JobPhase::kPaused &&
      phase != JobPhase::kReturning)
    return "the printer takes no commands now";
  if (phase != JobPhase::kPaused && places(command))
    return fmt::format("{} would spoil the print; pause it first", command_word(command));
  engine_.submit(command, LineOrigin::kInjected);
  return std::nullopt;
}

bool PrintJob::finished() const {
  return progress_.phase == JobPhase::kCompleted || progress_.phase == JobPhase::kCancelled ||
         progress_.phase == JobPhase::kFailed;
}

void PrintJob::account_for_time(Instant now) {
  starvation_.advance(now, progress_.phase == JobPhase::kPrinting ? engine_.obstacle() : Obstacle::kNone);
}

void PrintJob::observe(Instant now) {
  while (true) {
    std::vector<Event> events = engine_.take_events();
    for (const Event& event : events) observe(event, now);
    events_.insert(events_.end(), events.begin(), events.end());
    for (const auto& act : std::exchange(deferred_, {})) act(now);
    const bool supplied = !finished() && supply(now);
    if (events.empty() && !supplied) break;
    engine_.tick(now);  // what was submitted may go out at once, and make room for more
  }
  progress_.wire = engine_.statistics();
  progress_.starved = starvation_.total();
  progress_.cautious = engine_.cautious();
  progress_.source_lines = reader_.position().lines;
  progress_.source_bytes = reader_.position().bytes;
  progress_.layer = reader_.progress().layer();
  progress_.layer_count = reader_.progress().layer_count();
  progress_.time_fraction = reader_.progress().fraction();
  progress_.seconds_left = reader_.progress().seconds_left();
  progress_.height = log_.printer().position[2];
  log_.record().layer = progress_.layer;
}

void PrintJob::observe(const Event& event, Instant now) {
  if (std::holds_alternative<Connected>(event)) on_connected();
  if (const auto* rejoined = std::get_if<Rejoined>(&event)) on_rejoined(rejoined->next);
  if (const auto* sent = std::get_if<LineSent>(&event); sent != nullptr && !sent->again) on_sent(sent->line);
  if (const auto* acknowledged = std::get_if<LineAcknowledged>(&event)) on_acknowledged(*acknowledged, now);
  if (const auto* received = std::get_if<ReplyReceived>(&event)) on_reply(received->reply, now);
  if (const auto* refused = std::get_if<LineRefused>(&event)) {
    // A part without one of its lines is not the part; a mistyped console command is only that.
    if (refused->origin == LineOrigin::kJob) fail(JobFailure::kLine, refused->reason, true);
  }
  if (const auto* ended = std::get_if<Ended>(&event)) on_ended(*ended);
}

bool PrintJob::supply(Instant now) {
  switch (progress_.phase) {
    case JobPhase::kPrinting:
      return ask_temperatures(now) || supply_job_line(now);
    case JobPhase::kPausing:
      return ask_temperatures(now) || supply_parking(now);
    case JobPhase::kPaused:
      if (progress_.paused_by == Instigator::kSource && options_.source_level() == SourceLevel::kPlenty) {
        go_back(now);
        return true;
      }
      look_again_.reset();
      if (progress_.paused_by == Instigator::kSource) look_again_ = now + kLookAgain;
      return ask_temperatures(now);
    case JobPhase::kReturning:
      // Not before: a host that comes next must be able to begin the way back again.
      if (!engine_.all_acknowledged()) return false;
      log_.record().parked_from.reset();
      set_phase(JobPhase::kPrinting);
      return true;
    case JobPhase::kFinishing:
    case JobPhase::kCancelling:
      return supply_ending();
    default:
      return false;
  }
}

bool PrintJob::ask_temperatures(Instant now) {
  if (!poll_due_ || now < *poll_due_) return false;
  poll_due_.reset();
  engine_.submit("M105", LineOrigin::kInjected);
  return true;
}

bool PrintJob::supply_job_line(Instant now) {
  if (!engine_.wants_line()) return false;
  look_again_.reset();
  if (options_.source_level && options_.source_level() == SourceLevel::kEmpty) {
    if (!starved_since_) starved_since_ = now;
    if (now >= *starved_since_ + options_.source_patience && log_.printer().position[2]) {
      ++progress_.parked_for_source;
      park(now, Instigator::kSource);
      return true;
    }
    look_again_ = now + kLookAgain;
    return false;
  }
  starved_since_.reset();
  if (std::optional<SourceCommand> next = reader_.next()) {
    supplied_.push_back(std::move(next->mark));
    engine_.submit(std::move(next->command), LineOrigin::kJob);
  } else {
    set_phase(JobPhase::kFinishing);
    poll_due_.reset();
  }
  return true;
}

void PrintJob::skip_object(const std::string& object) {
  ++revision_;
  reader_.filter().skip_object(object);
}

void PrintJob::submit_all(const std::vector<std::string>& commands) {
  for (const std::string& command : commands) engine_.submit(command, LineOrigin::kProtocol);
}

void PrintJob::set_phase(JobPhase phase) {
  progress_.phase = phase;
  ++revision_;
}

std::string PrintJob::place() const {
  const std::optional<double>& height = log_.printer().position[2];
  std::string text = fmt::format("line {} of the file, {}", log_.source_line(),
                                 height ? fmt::format("{:.2f} mm high", *height) : "height unknown");
  if (progress_.layer > 0) text += fmt::format(", layer {}", progress_.layer);
  return text;
}

void PrintJob::give_up(JobFailure kind, const std::string& why) {
  if (failure_kind_ != JobFailure::kNone) return;
  failure_kind_ = kind;
  failure_ = why;
  deferred_.emplace_back([this](Instant then) { cancel(then); });
}

void PrintJob::fail(JobFailure kind, std::string why, bool may_listen) {
  if (finished()) return;
  failure_kind_ = kind;
  failure_ = std::move(why);
  set_phase(JobPhase::kFailed);
  engine_.close(failure_);
  if (may_listen && options_.heaters_off_on_failure) last_words_ = "\nM104 S0\nM140 S0\nM107\n";
}

}  // namespace lamina::transport
