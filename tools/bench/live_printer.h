#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "transport/emulator/emulator_server.h"
#include "transport/port/pty_host.h"

namespace lamina::tools {

/// An emulated printer behind a pseudo-terminal, in a thread of its own; it outlives its hosts. It heats
/// within seconds: what is measured is the print.
class LivePrinter {
 public:
  /// `overhear` is called, in the printer's thread, with every piece of bytes that a host has sent.
  explicit LivePrinter(double time_scale, transport::MotionOptions motion = {},
                       std::function<void(std::string_view)> overhear = {});
  LivePrinter(const LivePrinter&) = delete;
  LivePrinter& operator=(const LivePrinter&) = delete;
  ~LivePrinter() { switch_off(); }

  /// What a host opens.
  const std::string& path() const { return device_.path(); }

  /// What was printed. The printer is off from here on.
  const transport::EmulatorServerResult& switch_off();

 private:
  /// The device, with an ear on it.
  class Device : public transport::PtyHost {
   public:
    std::size_t read(std::span<char> into) override;
    std::function<void(std::string_view)> overhear;
  };

  Device device_;
  std::atomic<bool> stop_{false};
  transport::EmulatorServerResult result_;
  std::thread thread_;
};

}  // namespace lamina::tools
