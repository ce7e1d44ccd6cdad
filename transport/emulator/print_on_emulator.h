#pragma once

#include <functional>
#include <string>
#include <vector>

#include "transport/emulator/emulator.h"
#include "transport/emulator/emulator_options.h"
#include "transport/emulator/print_record.h"
#include "transport/emulator/wire.h"
#include "transport/session/print_job.h"
#include "transport/session/print_result.h"

namespace lamina::transport {

struct EmulatedPrintOptions {
  PrintJobOptions job;
  EmulatorOptions emulator;
  WireOptions to_printer;
  WireOptions to_host;
  PrintCallbacks callbacks;
  /// Called once per step of the simulation: the place to pause, resume, inject.
  std::function<void(PrintJob&, Instant)> steer;
  /// Asked once per step of the simulation; true cancels the print.
  std::function<bool()> cancelled;
  /// Simulated time after which the print counts as hung. DEFAULT: 30 days.
  Duration time_limit = std::chrono::hours(24 * 30);
};

struct EmulatedPrint {
  PrintResult result;       ///< `elapsed` is simulated time
  PrintReport report;       ///< what the emulated printer did
  std::vector<Bead> beads;  ///< empty unless options.emulator.record is kBeads
};

/// Prints on an emulated printer in simulated time, as fast as the machine goes: the print job and the
/// emulator joined by two wires in one loop that jumps from event to event. Same input, same result, whatever
/// the machine does. A print that exceeds the time limit, or in which nothing can happen any more, ends as
/// kFailed.
EmulatedPrint print_on_emulator(LineSource source, const EmulatedPrintOptions& options = {});

}  // namespace lamina::transport
