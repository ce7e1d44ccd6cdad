#include "tools/cli/print_outcome.h"

#include <cmath>
#include <iostream>

#include <fmt/format.h>

#include "gcode/marlin/time_text.h"
#include "tools/cli/emulated_printer.h"
#include "tools/cli/failure.h"
#include "tools/cli/json.h"

namespace lamina::tools {

namespace {

constexpr double kVolumeTolerance = 0.005;  // of the planned volume: what a faithful printer stays within

/// Less is not worth a word.
constexpr double kNotableStarvation = 0.1;  // s

/// Deposited against planned volume: 0.01 = one percent too much.
std::optional<double> volume_error(const PrintOutcome& outcome, const PrintSource& source) {
  if (!outcome.emulated || source.planned_filament() <= 0.0) return std::nullopt;
  return outcome.emulated->filament / source.planned_filament() - 1.0;
}

/// What the link cost, where it did.
std::string link_text(const transport::JobProgress& progress) {
  std::string text;
  const transport::Starvation& starved = progress.starved;
  if (transport::to_seconds(starved.total()) >= kNotableStarvation) {
    text += fmt::format(
        "  starved   about {:.1f} s without enough moves: {:.1f} s the link, {:.1f} s lines sent again, "
        "{:.1f} s the slicer\n",
        transport::to_seconds(starved.total()), transport::to_seconds(starved.by_wire),
        transport::to_seconds(starved.by_recovery), transport::to_seconds(starved.by_source));
  }
  if (progress.wire.stray_replies > 0) {
    text += fmt::format("  strays    {} answers to nothing that was sent: the link damages lines\n",
                        progress.wire.stray_replies);
  }
  return text;
}

}  // namespace

void say_outcome(const OutcomeForm& form, const PrintOutcome& outcome, const PrintSource& source,
                 const gcode::FilamentOptions& filament) {
  const transport::JobProgress& progress = outcome.result.progress;
  const double planned = source.planned_filament() * filament.area();
  const std::optional<double> error = volume_error(outcome, source);
  const double seconds = transport::to_seconds(outcome.result.elapsed);
  if (form.json) {
    Json json{{"outcome", "completed"},
              {"layers", source.layer()},
              {"lines_sent", progress.job_lines_sent},
              {"lines_acknowledged", progress.job_lines_acknowledged},
              {"lines_sent_again", progress.wire.lines_sent_again},
              {"stray_replies", progress.wire.stray_replies},
              {"starved_seconds",
               {{"wire", transport::to_seconds(progress.starved.by_wire)},
                {"recovery", transport::to_seconds(progress.starved.by_recovery)},
                {"source", transport::to_seconds(progress.starved.by_source)}}},
              {"seconds", seconds},
              {"planned_mm3", planned}};
    if (outcome.emulated) json["emulated"] = to_json(*outcome.emulated);
    if (error) json["volume_error"] = *error;
    std::cout << to_text(json) << '\n';
    return;
  }
  std::cout << fmt::format("completed: {}\n  lines     {} sent, {} acknowledged, {} sent again\n", form.input,
                           progress.job_lines_sent, progress.job_lines_acknowledged,
                           progress.wire.lines_sent_again);
  std::cout << fmt::format("  time      {}{}, heating and homing included\n", gcode::duration_text(seconds),
                           outcome.emulated ? " on the emulated printer" : "");
  std::cout << link_text(progress);
  if (outcome.emulated) std::cout << report_text(*outcome.emulated);
  if (error)
    std::cout << fmt::format("  planned   {:.2f} mm^3: {:+.3f} % deposited\n", planned, 100.0 * *error);
}

void refuse_faults(const PrintOutcome& outcome, const PrintSource& source) {
  const transport::JobProgress& progress = outcome.result.progress;
  if (progress.job_lines_sent != progress.job_lines_acknowledged)
    throw Failure(ExitCode::kPrinter, "not every line was acknowledged");
  if (const std::optional<double> error = volume_error(outcome, source);
      error && std::abs(*error) > kVolumeTolerance) {
    throw Failure(ExitCode::kPrinter,
                  fmt::format("the deposited volume is off by {:+.2f} %", 100.0 * *error));
  }
}

ExitCode exit_code(const PrintOutcome& outcome) {
  switch (outcome.result.failure_kind) {
    case transport::JobFailure::kMismatch:
      return ExitCode::kFit;
    case transport::JobFailure::kSourceChanged:
    case transport::JobFailure::kLine:
      return ExitCode::kInput;
    case transport::JobFailure::kNotResumable:
    case transport::JobFailure::kColdExtrusion:
    case transport::JobFailure::kDisconnected:
      return ExitCode::kPrinter;
    case transport::JobFailure::kNone:
    case transport::JobFailure::kConversation:
      break;
  }
  if (!outcome.end) return ExitCode::kPort;
  const bool nobody =
      *outcome.end == transport::EndReason::kNotAPrinter || *outcome.end == transport::EndReason::kNoAnswer;
  return nobody ? ExitCode::kPort : ExitCode::kPrinter;
}

}  // namespace lamina::tools
