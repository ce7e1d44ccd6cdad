#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "transport/emulator/emulator.h"
#include "transport/emulator/emulator_options.h"
#include "transport/emulator/print_record.h"
#include "transport/emulator/wire.h"
#include "transport/port/port.h"

namespace lamina::transport {

struct EmulatorServerOptions {
  EmulatorOptions emulator;
  /// How many seconds pass for the printer in one second. Baud rate and latency of the wires scale with it.
  double time_scale = 1;
  WireOptions to_printer;
  WireOptions to_host;
  /// Called now and then (at most about ten times a second) from the server's loop; may be empty.
  std::function<void(const Emulator&)> on_progress;
};

struct EmulatorServerResult {
  PrintReport report;
  std::vector<Bead> beads;  ///< empty unless options.emulator.record is kBeads
};

/// Runs an emulated printer behind `device` (the printer's end of a pty or of a memory port) by the wall
/// clock until `stop` becomes true, the device goes away or is unplugged to order. Hosts may come and go.
/// Bytes that no host reads are dropped once 64 KiB of them wait. This is the rim: it reads the clock and
/// sleeps in the port.
EmulatorServerResult serve_emulator(Port& device, const EmulatorServerOptions& options,
                                    const std::atomic<bool>& stop);

}  // namespace lamina::transport
