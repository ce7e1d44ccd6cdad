#pragma once

#include <atomic>

#include "transport/port/port.h"
#include "transport/session/print_job.h"
#include "transport/session/print_result.h"

namespace lamina::transport {

/// Prints `job` (not yet started) through `port` in real time; blocks until it has ended. This is the rim: it
/// reads the clock and sleeps in the port, at most a tenth of a second at a time. When `cancel` becomes true
/// the print is cancelled with the heaters off; when it is still true ten seconds of silence later the runner
/// gives up. A port that fails ends the print with its message; nothing is thrown.
PrintResult run_print(Port& port, PrintJob& job, const PrintCallbacks& callbacks,
                      const std::atomic<bool>& cancel);

}  // namespace lamina::transport
