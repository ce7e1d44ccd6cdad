#pragma once

#include <atomic>
#include <thread>

#include "transport/emulator/emulator_server.h"
#include "transport/session/print_job.h"

namespace lamina::tests {

/// An emulated printer in a thread of its own, until stopped.
class ServedPrinter {
 public:
  ServedPrinter(transport::Port& device, const transport::EmulatorServerOptions& options)
      : options_(options), thread_([this, &device] { result_ = serve_emulator(device, options_, stop_); }) {}
  ServedPrinter(const ServedPrinter&) = delete;
  ServedPrinter& operator=(const ServedPrinter&) = delete;
  ~ServedPrinter() { stop(); }

  const transport::EmulatorServerResult& stop() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    return result_;
  }

 private:
  transport::EmulatorServerOptions options_;
  transport::EmulatorServerResult result_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

/// What takes the printer seconds is over in milliseconds.
inline transport::EmulatorServerOptions fast_printer() {
  transport::EmulatorServerOptions options;
  options.time_scale = 200;
  return options;
}

/// Does not wait long for a printer to say `start`.
inline transport::PrintJobOptions quick_start() {
  transport::PrintJobOptions options;
  options.engine.start_wait = std::chrono::milliseconds(200);
  return options;
}

}  // namespace lamina::tests
