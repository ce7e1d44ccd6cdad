#pragma once

#include <functional>
#include <string>

#include "transport/session/print_job.h"

namespace lamina::transport {

/// How a print went.
struct PrintResult {
  JobPhase outcome = JobPhase::kFailed;  ///< kCompleted, kCancelled or kFailed
  std::string failure;                   ///< one line; empty unless it failed
  JobFailure failure_kind = JobFailure::kNone;
  Instigator cancelled_by = Instigator::kUser;
  JobProgress progress;
  Duration elapsed{};  ///< on the timeline of the print: real, or simulated
};

/// Calls back from inside the print's loop. Both may be empty; neither may block for long, and neither may
/// throw.
struct PrintCallbacks {
  std::function<void(const Event&)> on_event;
  /// Whenever something has happened, and at least ten times a second of the print's time.
  std::function<void(const JobProgress&)> on_progress;
};

}  // namespace lamina::transport
