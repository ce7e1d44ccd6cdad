#include "transport/session/print_job.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "transport/protocol/line_stripper.h"

namespace lamina::transport {

PrintJob::PrintJob(LineSource source, PrintJobOptions options)
    : source_(std::move(source)), options_(std::move(options)), engine_(options_.engine) {}

void PrintJob::start(Instant now) {
  engine_.connect(now);
}

void PrintJob::receive(std::string_view bytes, Instant now) {
  engine_.receive(bytes, now);
  observe(now);
}

void PrintJob::tick(Instant now) {
  engine_.tick(now);
  observe(now);
}

std::string PrintJob::take_output() {
  return engine_.take_output() + std::exchange(last_words_, {});
}

std::vector<Event> PrintJob::take_events() {
  return std::exchange(events_, {});
}

std::optional<Instant> PrintJob::deadline() const {
  std::optional<Instant> due = engine_.deadline();
  if (poll_due_ && (!due || *poll_due_ < *due)) due = poll_due_;
  return finished() ? std::nullopt : due;
}

void PrintJob::inject(std::string_view command) {
  if (progress_.phase == JobPhase::kPrinting) engine_.submit(strip_line(command), LineOrigin::kInjected);
}

void PrintJob::cancel(Instant now) {
  if (finished() || progress_.phase == JobPhase::kCancelling) return;
  source_ = [] { return std::nullopt; };
  if (progress_.phase == JobPhase::kConnecting) {
    engine_.close("cancelled before the printer answered");
    progress_.phase = JobPhase::kCancelled;
    return;
  }
  progress_.phase = JobPhase::kCancelling;
  ending_sent_ = false;
  poll_due_.reset();
  engine_.drop_queued();
  const auto& outstanding = engine_.outstanding();
  const bool waits = std::any_of(outstanding.begin(), outstanding.end(), [](const OutstandingLine& line) {
    return line.command_class == CommandClass::kBlocking;
  });
  if (waits) engine_.send_urgent("M108", now);
  tick(now);
}

bool PrintJob::finished() const {
  return progress_.phase == JobPhase::kCompleted || progress_.phase == JobPhase::kCancelled ||
         progress_.phase == JobPhase::kFailed;
}

void PrintJob::observe(Instant now) {
  while (true) {
    std::vector<Event> events = engine_.take_events();
    for (const Event& event : events) observe(event, now);
    events_.insert(events_.end(), events.begin(), events.end());
    const bool supplied = !finished() && supply(now);
    if (events.empty() && !supplied) break;
    engine_.tick(now);  // what was submitted may go out at once, and make room for more
  }
  progress_.wire = engine_.statistics();
  progress_.cautious = engine_.cautious();
}

void PrintJob::observe(const Event& event, Instant now) {
  if (std::holds_alternative<Connected>(event)) on_connected();
  if (const auto* sent = std::get_if<LineSent>(&event)) {
    if (sent->line.origin == LineOrigin::kJob && !sent->again) ++progress_.job_lines_sent;
  }
  if (const auto* acknowledged = std::get_if<LineAcknowledged>(&event))
    on_acknowledged(acknowledged->line, now);
  if (const auto* received = std::get_if<ReplyReceived>(&event)) on_reply(received->reply);
  if (const auto* refused = std::get_if<LineRefused>(&event)) {
    // A part without one of its lines is not the part; a mistyped console command is only that.
    if (refused->origin == LineOrigin::kJob) fail(refused->reason, true);
  }
  if (const auto* ended = std::get_if<Ended>(&event)) on_ended(*ended);
}

void PrintJob::on_connected() {
  progress_.phase = JobPhase::kPrinting;
  engine_.submit("M115", LineOrigin::kProtocol);
}

void PrintJob::on_acknowledged(const NumberedLine& line, Instant now) {
  if (line.origin == LineOrigin::kJob) ++progress_.job_lines_acknowledged;
  if (options_.temperature_interval == Duration{} || line.origin == LineOrigin::kJob) return;
  if (progress_.phase != JobPhase::kPrinting) return;
  if (line.command == "M115") {
    if (capabilities_["AUTOREPORT_TEMP"]) {
      engine_.submit(fmt::format("M155 S{}", std::max<std::int64_t>(
                                                 1, options_.temperature_interval / std::chrono::seconds(1))),
                     LineOrigin::kProtocol);
    } else {
      poll_due_ = now;
    }
  }
  // The next question is asked some time after the last one was answered, so questions never pile up.
  if (line.command == "M105" && line.origin == LineOrigin::kInjected)
    poll_due_ = now + options_.temperature_interval;
}

void PrintJob::on_reply(const Reply& reply) {
  if (const auto* temperatures = std::get_if<TemperatureReport>(&reply))
    progress_.temperatures = *temperatures;
  if (const auto* ok = std::get_if<OkReply>(&reply); ok != nullptr && ok->temperatures) {
    progress_.temperatures = *ok->temperatures;
  }
  if (const auto* capability = std::get_if<CapabilityReply>(&reply))
    capabilities_[capability->name] = capability->present;
  if (const auto* firmware = std::get_if<FirmwareReply>(&reply)) firmware_ = *firmware;
}

void PrintJob::on_ended(const Ended& ended) {
  if (ended.reason == EndReason::kClosed || finished()) return;
  fail(fmt::format("{} (line {} of the wire, {} lines of the print acknowledged)", ended.detail, ended.next,
                   progress_.job_lines_acknowledged),
       ended.reason != EndReason::kHalted && ended.reason != EndReason::kNotAPrinter);
}

bool PrintJob::supply(Instant now) {
  switch (progress_.phase) {
    case JobPhase::kPrinting:
      return ask_temperatures(now) || supply_job_line();
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

bool PrintJob::supply_job_line() {
  if (!engine_.wants_line()) return false;
  if (std::optional<std::string> command = next_command()) {
    engine_.submit(*std::move(command), LineOrigin::kJob);
  } else {
    progress_.phase = JobPhase::kFinishing;
    poll_due_.reset();
  }
  return true;
}

bool PrintJob::supply_ending() {
  const bool cancelling = progress_.phase == JobPhase::kCancelling;
  if (!ending_sent_) {
    if (!engine_.wants_line()) return false;
    ending_sent_ = true;
    if (cancelling) {
      for (const std::string& command : options_.cancel_commands)
        engine_.submit(command, LineOrigin::kProtocol);
    }
    engine_.submit("M400", LineOrigin::kProtocol);
    if (capabilities_["AUTOREPORT_TEMP"]) engine_.submit("M155 S0", LineOrigin::kProtocol);
    return true;
  }
  if (engine_.all_acknowledged()) {
    progress_.phase = cancelling ? JobPhase::kCancelled : JobPhase::kCompleted;
    engine_.close(cancelling ? "cancelled" : "completed");
  }
  return false;
}

std::optional<std::string> PrintJob::next_command() {
  while (std::optional<std::string> line = source_()) {
    ++progress_.source_lines;
    progress_.source_bytes += static_cast<std::int64_t>(line->size()) + 1;
    std::string command = strip_line(*line);
    // The numbering on this wire is ours, and the firmware would see this text anywhere in a line.
    if (command.empty() || command.find("M110") != std::string::npos) continue;
    return command;
  }
  return std::nullopt;
}

void PrintJob::fail(std::string why, bool may_listen) {
  if (finished()) return;
  failure_ = std::move(why);
  progress_.phase = JobPhase::kFailed;
  engine_.close(failure_);
  if (may_listen && options_.heaters_off_on_failure) last_words_ = "\nM104 S0\nM140 S0\nM107\n";
}

}  // namespace lamina::transport
