// How a print job leaves the part and comes back to it: pauses, cancels, the end; print_job.cpp has the rest.

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "transport/session/print_job.h"

namespace lamina::transport {

namespace {

/// Between two tries to break off a wait.
constexpr Duration kBreakInterval = std::chrono::seconds(2);
constexpr double kColdest = 170;  // deg C at which filament may be drawn back

}  // namespace

bool PrintJob::supply_parking(Instant now) {
  // Job lines that were handed over go first: commands from the side would overtake them.
  if (!engine_.wants_line()) return false;
  if (!log_.record().parked_from) {
    log_.record().parked_from = log_.printer();
    submit_all(park_commands(log_.printer(), options_.park, nozzle_is_hot()));
    return true;
  }
  if (!engine_.all_acknowledged()) return false;
  parked_since_ = now;
  set_phase(JobPhase::kPaused);
  if (std::exchange(resume_wanted_, false)) go_back(now);
  return true;
}

bool PrintJob::supply_ending() {
  const bool cancelling = progress_.phase == JobPhase::kCancelling;
  if (!ending_sent_) {
    if (!engine_.wants_line()) return false;
    ending_sent_ = true;
    if (cancelling) submit_all(cancel_commands(log_.printer(), options_.park, nozzle_is_hot()));
    submit_all({"M400"});
    if (facts_.can("AUTOREPORT_TEMP")) submit_all({"M155 S0"});
    return true;
  }
  if (engine_.all_acknowledged()) {
    const bool failed = failure_kind_ != JobFailure::kNone;
    set_phase(failed ? JobPhase::kFailed : cancelling ? JobPhase::kCancelled : JobPhase::kCompleted);
    if (!failed) log_.record().ended = cancelling ? "cancelled" : "completed";
    engine_.close(cancelling ? "cancelled" : "completed");
  }
  return false;
}

void PrintJob::pause(Instant now) {
  if (progress_.phase == JobPhase::kPaused && progress_.paused_by == Instigator::kSource)
    progress_.paused_by = Instigator::kUser;
  if (progress_.phase == JobPhase::kPrinting) park(now, Instigator::kUser);
}

void PrintJob::resume(Instant now) {
  if (progress_.phase == JobPhase::kPausing) {
    // Half way there: it goes on from the parking place.
    resume_wanted_ = true;
    return;
  }
  if (progress_.phase != JobPhase::kPaused) return;
  if (log_.record().parked_from) {
    go_back(now);
  } else {
    set_phase(JobPhase::kPrinting);
    tick(now);
  }
}

void PrintJob::park(Instant now, Instigator by) {
  progress_.paused_by = by;
  starved_since_.reset();
  set_phase(JobPhase::kPausing);
  tick(now);
}

/// Called with nothing queued, so that the first job line follows.
void PrintJob::go_back(Instant now) {
  const MachineState& goal = *log_.record().parked_from;
  ParkOptions options = options_.park;
  // It never got away from the part, where a prime would make a blob.
  if (log_.printer().position == goal.position) options.prime = 0;
  submit_all(return_commands(with_targets(log_.printer(), progress_.temperatures), goal, options));
  look_again_.reset();
  set_phase(JobPhase::kReturning);
  tick(now);
}

void PrintJob::cool_down_parked(Instant now) {
  const MachineState& printer = log_.printer();
  if (!engine_.all_acknowledged()) return;
  if (now >= parked_since_ + options_.park.keep_nozzle_hot) {
    for (const auto& [tool, target] : printer.nozzles) {
      if (target > 0) submit_all({fmt::format("M104 T{} S0", tool)});
    }
  }
  if (now >= parked_since_ + options_.park.keep_bed_hot && printer.bed > 0) submit_all({"M140 S0"});
}

void PrintJob::cancel(Instant now, Instigator by) {
  if (finished() || progress_.phase == JobPhase::kCancelling) return;
  cancelled_by_ = by;
  reader_.end();
  if (progress_.phase == JobPhase::kConnecting) {
    engine_.close("cancelled before the printer answered");
    set_phase(JobPhase::kCancelled);
    return;
  }
  ending_sent_ = false;
  poll_due_.reset();
  look_again_.reset();
  engine_.drop_queued();
  supplied_.clear();
  break_due_ = now;
  set_phase(JobPhase::kCancelling);
  tick(now);
}

void PrintJob::break_waits(Instant now) {
  const auto& outstanding = engine_.outstanding();
  const bool waits = std::any_of(outstanding.begin(), outstanding.end(), [](const OutstandingLine& line) {
    return line.command_class == CommandClass::kBlocking;
  });
  // A stage of a filament change, or a damaged byte, may have swallowed the last one.
  if (waits && !ending_sent_ && now >= break_due_) {
    engine_.send_urgent("M108", now);
    break_due_ = now + kBreakInterval;
  }
  if (!waits || ending_sent_) break_due_ = Instant::max();
}

void PrintJob::halt(Instant now) {
  if (finished()) return;
  discard_ = true;
  engine_.take_output();
  engine_.send_urgent("M112", now);
  last_words_ = engine_.take_output();
  fail(JobFailure::kConversation,
       "stopped at once (M112) at " + place() + "; switch the printer off and on before the next print",
       false);
}

void PrintJob::answer(int button, Instant now) {
  // The emergency parser hears both in the middle of a command; M108 is heard without it, too.
  if (progress_.prompt.shown && facts_.can("EMERGENCY_PARSER")) {
    engine_.send_urgent(fmt::format("M876 S{}", button), now);
  } else {
    engine_.send_urgent("M108", now);
  }
  progress_.prompt = {};
  tick(now);
}

bool PrintJob::nozzle_is_hot() const {
  const HeaterReading* reading = progress_.temperatures.find("T");
  if (reading == nullptr) reading = progress_.temperatures.find(fmt::format("T{}", log_.printer().tool));
  return reading != nullptr && reading->current >= kColdest;
}

}  // namespace lamina::transport
