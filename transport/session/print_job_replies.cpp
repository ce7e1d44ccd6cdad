// What a print job makes of the engine's events and the printer's replies; print_job.cpp has the rest.

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "transport/session/print_job.h"

namespace lamina::transport {

void PrintJob::on_sent(const NumberedLine& line) {
  ++revision_;
  SourceMark mark;
  if (line.origin == LineOrigin::kJob) {
    ++progress_.job_lines_sent;
    mark = std::move(supplied_.front());
    supplied_.pop_front();
  }
  log_.sent(line, mark);
}

void PrintJob::on_acknowledged(const LineAcknowledged& acknowledged, Instant now) {
  const NumberedLine& line = acknowledged.line;
  starvation_.acknowledged(acknowledged, now);
  log_.acknowledged(line.number);
  progress_.waits_for_user = false;
  if (line.origin == LineOrigin::kJob) {
    ++progress_.job_lines_acknowledged;
    return;
  }
  if (progress_.phase == JobPhase::kChecking) {
    const std::string_view last_question = rejoined_at_ ? "M114" : "M115";
    if (line.command == last_question) on_printer_known(now);
    return;
  }
  // The next question is asked some time after the last one was answered, so questions never pile up.
  const bool asks = options_.temperature_interval != Duration{} && !facts_.can("AUTOREPORT_TEMP");
  if (line.command == "M105" && line.origin == LineOrigin::kInjected && asks)
    poll_due_ = now + options_.temperature_interval;
}

void PrintJob::on_reply(const Reply& reply, Instant now) {
  facts_.take(reply);
  if (const auto* temperatures = std::get_if<TemperatureReport>(&reply))
    progress_.temperatures = *temperatures;
  if (const auto* ok = std::get_if<OkReply>(&reply)) {
    if (ok->temperatures) progress_.temperatures = *ok->temperatures;
    if (ok->planner_free) progress_.planner_free = ok->planner_free;
  }
  if (const auto* position = std::get_if<PositionReply>(&reply)) found_ = *position;
  if (const auto* busy = std::get_if<BusyReply>(&reply)) {
    progress_.waits_for_user =
        busy->reason == BusyReason::kPausedForUser || busy->reason == BusyReason::kPausedForInput;
  }
  if (const auto* action = std::get_if<HostActionReply>(&reply)) on_host_action(*action, now);
  if (const auto* unknown = std::get_if<UnknownCommandReply>(&reply)) on_unknown_command(unknown->command);
  if (const auto* text = std::get_if<TextReply>(&reply)) {
    const bool printing = progress_.phase == JobPhase::kPrinting || progress_.phase == JobPhase::kFinishing;
    if (printing && text->text.find("cold extrusion prevented") != std::string::npos) {
      give_up(
          JobFailure::kColdExtrusion,
          fmt::format("the nozzle was too cold to extrude ({}): the part lacks plastic from there on; check "
                      "the temperatures of the file and the heater",
                      place()));
    }
  }
}

void PrintJob::on_host_action(const HostActionReply& action, Instant now) {
  progress_.prompt.take(action);
  const std::string& name = action.action;
  if (name == "pause" || name == "out_of_filament" || name == "filament_runout") {
    deferred_.emplace_back([this](Instant then) {
      if (progress_.phase == JobPhase::kPrinting) park(then, Instigator::kPrinter);
    });
  } else if (name == "paused") {
    // The printer has parked by itself; it only must not be fed.
    if (progress_.phase == JobPhase::kPrinting) {
      progress_.paused_by = Instigator::kPrinter;
      parked_since_ = now;
      set_phase(JobPhase::kPaused);
    }
  } else if (name == "resume" || name == "resumed") {
    deferred_.emplace_back([this](Instant then) { resume(then); });
  } else if (name == "cancel") {
    deferred_.emplace_back([this](Instant then) { cancel(then, Instigator::kPrinter); });
  } else if (name == "disconnect") {
    fail(JobFailure::kDisconnected, "the printer asked to be left alone; the print stopped at " + place(),
         false);
  }
}

void PrintJob::on_unknown_command(const std::string& command) {
  // Only what was really sent: the tail of a cut line may look like anything.
  const auto& lines = log_.record().lines;
  const bool ours = std::any_of(lines.begin(), lines.end(), [&](const JournalLine& line) {
    return wire_form(line.command, options_.engine.form) == command;
  });
  if (!ours) return;
  const std::string code(command_word(command));
  if (classify(command) == CommandClass::kMotion) {
    give_up(JobFailure::kLine,
            fmt::format("the printer does not know {}, so the part lacks a move at {}; slice it without arcs",
                        code, place()));
    return;
  }
  reader_.filter().lacks(code);
}

void PrintJob::on_ended(const Ended& ended) {
  if (ended.reason == EndReason::kClosed || finished()) return;
  fail(JobFailure::kConversation,
       fmt::format("{} ({}; line {} of the wire, {} lines of the print acknowledged)", ended.detail, place(),
                   ended.next, progress_.job_lines_acknowledged),
       ended.reason != EndReason::kHalted && ended.reason != EndReason::kNotAPrinter);
}

}  // namespace lamina::transport
