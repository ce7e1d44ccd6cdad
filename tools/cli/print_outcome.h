#pragma once

#include <optional>
#include <string>

#include "gcode/filament_options.h"
#include "tools/cli/exit_codes.h"
#include "tools/cli/print_source.h"
#include "transport/emulator/print_record.h"
#include "transport/protocol/events.h"
#include "transport/session/print_result.h"

namespace lamina::tools {

/// How a print went, on whatever it was printed.
struct PrintOutcome {
  transport::PrintResult result;
  std::optional<transport::EndReason> end;         ///< Why the conversation ended, where it did.
  std::optional<transport::PrintReport> emulated;  ///< Of the emulated printer.
};

/// How it is told.
struct OutcomeForm {
  std::string input;  ///< What was printed.
  bool json = false;
};

/// Tells on standard output how a completed print went.
void say_outcome(const OutcomeForm& form, const PrintOutcome& outcome, const PrintSource& source,
                 const gcode::FilamentOptions& filament);

/// Throws Failure where a print that says it is completed is not what was planned.
void refuse_faults(const PrintOutcome& outcome, const PrintSource& source);

/// Of a print that failed.
ExitCode exit_code(const PrintOutcome& outcome);

}  // namespace lamina::tools
