#pragma once

#include <atomic>
#include <chrono>
#include <thread>
#include <variant>

#include "tests/transport/sample_print.h"
#include "transport/emulator/emulator_server.h"
#include "transport/session/print_job.h"
#include "transport/session/runner.h"

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

/// Does not wait long for a printer to say `start`, and knows no baud rate: a printer whose time runs faster
/// answers sooner than any wire could, which the engine would take for answers to other lines.
inline transport::PrintJobOptions quick_start() {
  transport::PrintJobOptions options;
  options.engine.start_wait = std::chrono::milliseconds(200);
  options.engine.baud = 0;
  return options;
}

/// Prints 6000 chords and lets the device go once 100 lines are sent.
inline transport::PrintResult print_until_unplugged(transport::Port& host, ServedPrinter& printer,
                                                    transport::Port& device) {
  transport::PrintJob job(source_of(sample_print(6000)), quick_start());
  std::atomic<bool> printing = false;
  transport::PrintCallbacks callbacks;
  callbacks.on_event = [&](const transport::Event& event) {
    if (const auto* sent = std::get_if<transport::LineSent>(&event))
      printing = printing || sent->line.number > 100;
  };
  std::thread unplug([&] {
    while (!printing) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    printer.stop();
    device.close();
  });
  const std::atomic<bool> cancel = false;
  transport::PrintResult result = run_print(host, job, callbacks, cancel);
  unplug.join();
  return result;
}

}  // namespace lamina::tests
