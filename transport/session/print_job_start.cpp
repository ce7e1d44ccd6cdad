// How a print job begins, anew or where another process left off; print_job.cpp has the rest.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "transport/session/print_job.h"
#include "transport/session/recovery.h"

namespace lamina::transport {

namespace {

/// Between where the printer says that it is (two decimals) and where it should be.
constexpr double kSamePlace = 0.02;  // mm

bool is_homed(const MachineState& printer) {
  return printer.homed[0] && printer.homed[1];
}

/// A heater that should be on is not, or is meant to be colder.
bool has_cooled(const MachineState& expected, const TemperatureReport& report) {
  const MachineState told = with_targets(expected, report);
  const auto colder = [&](const auto& nozzle) { return told.nozzles.at(nozzle.first) < nozzle.second - 1; };
  return told.bed < expected.bed - 1 || std::any_of(expected.nozzles.begin(), expected.nozzles.end(), colder);
}

/// Lines that may have gone out after the last record that reached the disk.
constexpr LineNumber kMostUnrecorded = 100'000;

bool has_begun(const JournalRecord& record) {
  return record.position.lines > 0 || record.parts > 0 ||
         std::any_of(record.lines.begin(), record.lines.end(),
                     [](const JournalLine& line) { return line.origin == LineOrigin::kJob; });
}

}  // namespace

void PrintJob::start(Instant now) {
  log_.record().source = options_.source;
  log_.record().source_size = options_.source_size;
  log_.record().port = options_.port;
  log_.record().baud = options_.baud;
  if (options_.resume && !has_begun(*options_.resume)) options_.resume.reset();
  if (!options_.resume) {
    log_.begin(0, {}, {}, {}, 0);
    engine_.connect(now);
    return;
  }
  if (prepare_resume()) engine_.rejoin(now);
}

/// Brings the source to where the settled lines end. False if that failed.
bool PrintJob::prepare_resume() {
  const JournalRecord& record = *options_.resume;
  try {
    reader_.filter().set_dialect(record.dialect);
    reader_.skip_to(record.position, record.filter, record.parts);
  } catch (const SourceChanged& changed) {
    fail(JobFailure::kSourceChanged, fmt::format("cannot go on with {}: {}", record.source, changed.what()),
         false);
    return false;
  }
  return true;
}

void PrintJob::on_connected() {
  if (options_.resume) {
    restarted_ = true;
    MachineState printer;
    const JournalRecord& record = *options_.resume;
    const MachineState goal = recovery_goal(record);
    // Its filament and its nozzle stand where they stood.
    printer.e_total = goal.e_total;
    printer.e_peak = goal.e_peak;
    printer.position[2] = lowest_height(record);
    log_.begin(0, printer, record.position, record.filter, record.parts);
    log_.record().parked_from = goal;
  }
  set_phase(JobPhase::kChecking);
  submit_all({"M115"});
}

void PrintJob::on_rejoined(LineNumber next) {
  rejoined_at_ = next;
  JournalRecord record = *options_.resume;
  const LineNumber arrived = next - 1;
  if (arrived < record.settled || arrived > record.last() + kMostUnrecorded) {
    // It counts, but not from us: it has restarted, or talked to another host since.
    on_connected();
    log_.begin(arrived, log_.printer(), record.position, record.filter, record.parts);
    submit_all({"M114"});
    return;
  }
  log_.begin(record.settled, record.printer, record.position, record.filter, record.parts);
  // Lines of the print that did not arrive come before the parking, which then did not arrive either.
  const auto first_lost =
      record.lines.begin() + std::clamp<LineNumber>(arrived - record.settled, 0, std::ssize(record.lines));
  const bool print_lost = std::any_of(first_lost, record.lines.end(), [](const JournalLine& line) {
    return line.origin == LineOrigin::kJob;
  });
  if (!print_lost) log_.record().parked_from = record.parked_from;
  const auto replay = [&](const JournalLine* line) {
    const bool of_job = line == nullptr || line->origin == LineOrigin::kJob;
    const LineNumber number = log_.record().last() + 1;
    if (!of_job) {
      log_.sent({number, line->command, line->origin}, {});
      return true;
    }
    std::optional<SourceCommand> command = reader_.next();
    if (!command || (line != nullptr && line->command != command->command)) return false;
    log_.sent({number, command->command, LineOrigin::kJob}, command->mark);
    return true;
  };
  for (LineNumber number = record.settled + 1; number <= arrived; ++number) {
    const auto at = static_cast<std::size_t>(number - record.settled) - 1;
    if (!replay(at < record.lines.size() ? &record.lines[at] : nullptr)) {
      fail(JobFailure::kSourceChanged,
           fmt::format("cannot go on with {}: it has changed since", record.source), false);
      return;
    }
  }
  expected_ = log_.printer();
  set_phase(JobPhase::kChecking);
  submit_all({"M115", "M114"});
}

/// Why the printer that was found counting is not as it was left; none if it is.
std::optional<std::string> PrintJob::rejoin_problem() const {
  if (restarted_) return "the printer has restarted, or another program has printed, since";
  if (!found_) return std::nullopt;
  const std::array<double, 3> found{found_->x, found_->y, found_->z};
  constexpr std::array<const char*, 3> kNames{"X", "Y", "Z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::optional<double>& expected = expected_->position[axis];
    if (expected && expected_->homed[axis] && std::abs(*expected - found[axis]) > kSamePlace) {
      return fmt::format("the printer stands at {}{:.2f}, not at {:.2f} where the print stopped",
                         kNames[axis], found[axis], *expected);
    }
  }
  return std::nullopt;
}

void PrintJob::on_printer_known(Instant now) {
  reader_.filter().set_dialect(dialect(facts_));
  log_.record().dialect = reader_.filter().dialect();
  if (options_.check) {
    if (const std::optional<std::string> mismatch = options_.check(facts_)) {
      fail(JobFailure::kMismatch, *mismatch, true);
      return;
    }
  }
  if (options_.temperature_interval != Duration{}) {
    if (facts_.can("AUTOREPORT_TEMP")) {
      submit_all({fmt::format(
          "M155 S{}", std::max<std::int64_t>(1, options_.temperature_interval / std::chrono::seconds(1)))});
    } else {
      poll_due_ = now;
    }
  }
  if (!options_.resume) {
    set_phase(JobPhase::kPrinting);
    return;
  }
  const std::optional<std::string> problem = rejoin_problem();
  if (!problem && is_homed(log_.printer())) {
    // The last host may have switched everything off with its last words, or a timeout has.
    submit_all(fan_commands(log_.printer()));
    const bool cooled = has_cooled(log_.printer(), progress_.temperatures);
    if (cooled && !log_.record().parked_from) log_.record().parked_from = log_.printer();
    if (log_.record().parked_from) {
      go_back(now);
    } else {
      set_phase(JobPhase::kPrinting);
    }
    return;
  }
  if (!problem && !log_.record().parked_from) {
    // It broke off before the homing of the file itself.
    set_phase(JobPhase::kPrinting);
    return;
  }
  recover(problem.value_or("the printer has restarted since"), now);
}

void PrintJob::recover(const std::string& problem, Instant now) {
  const bool displaced = !restarted_ && !log_.record().parked_from;
  const std::optional<MachineState> goal = log_.record().parked_from;
  const std::optional<std::string> obstacle = goal ? unrecoverable(*goal) : std::nullopt;
  if (obstacle) {
    fail(JobFailure::kNotResumable,
         fmt::format("cannot go on: {}, and {}; begin the print anew", problem, *obstacle), false);
  } else if (displaced) {
    fail(
        JobFailure::kNotResumable,
        fmt::format("cannot go on: {}; bring it back there, or switch the printer off and on and resume with "
                    "--after-restart",
                    problem),
        false);
  } else if (!options_.resume_after_restart) {
    fail(JobFailure::kNotResumable,
         fmt::format(
             "cannot simply go on: {}; if the part still sticks to the bed and nobody has moved the Z axis, "
             "resume with --after-restart",
             problem),
         false);
  } else {
    submit_all(recover_commands(log_.printer(), *goal, options_.park));
    set_phase(JobPhase::kReturning);
    tick(now);
  }
}

}  // namespace lamina::transport
