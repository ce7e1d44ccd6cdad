#pragma once

#include <atomic>
#include <functional>
#include <utility>

#include "transport/port/port.h"
#include "transport/session/command_session.h"
#include "transport/session/journal_file.h"
#include "transport/session/print_job.h"
#include "transport/session/print_result.h"

namespace lamina::transport {

struct RunOptions {
  RunOptions() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): callbacks are all that most prints need
  RunOptions(PrintCallbacks for_print) : callbacks(std::move(for_print)) {}

  PrintCallbacks callbacks;
  /// Called in every turn of the loop, at least ten times a second: the place to pause, resume, inject. May
  /// be empty; must not block.
  std::function<void(PrintJob&, Instant)> steer;
  /// Kept up as the print goes, so that another process can go on; null: none.
  JournalFile* journal = nullptr;
  /// How many seconds pass for the job in one second: for an emulated printer that runs as fast.
  double time_scale = 1;
};

/// Prints `job` (not yet started) through `port` in real time; blocks until it has ended. This is the rim: it
/// reads the clock and sleeps in the port, at most a tenth of a second at a time. When `cancel` becomes true
/// the print is cancelled with the heaters off; when it is still true ten seconds of silence later the runner
/// gives up. A port or a journal that fails ends the print with its message; nothing is thrown.
PrintResult run_print(Port& port, PrintJob& job, const RunOptions& options, const std::atomic<bool>& cancel);

/// Holds a conversation (not yet started) until it is finished or `cancel` becomes true; `on_answer` is
/// called for every command that the printer has done, and may stop the session. Throws PortError.
void run_commands(Port& port, CommandSession& session,
                  const std::function<void(const CommandAnswer&)>& on_answer, const std::atomic<bool>& cancel,
                  double time_scale = 1);

}  // namespace lamina::transport
