#include "tools/bench/live_printer.h"

#include <utility>

namespace lamina::tools {

LivePrinter::LivePrinter(double time_scale, transport::MotionOptions motion,
                         std::function<void(std::string_view)> overhear) {
  device_.overhear = std::move(overhear);
  transport::EmulatorServerOptions options;
  options.time_scale = time_scale;
  options.emulator.motion = motion;
  options.emulator.record = transport::RecordDetail::kBeads;
  options.emulator.thermal.hotend = {200, 160, 8};
  options.emulator.thermal.bed = {200, 400, 4};
  options.emulator.thermal.residency = std::chrono::seconds(1);
  thread_ = std::thread([this, options] { result_ = transport::serve_emulator(device_, options, stop_); });
}

const transport::EmulatorServerResult& LivePrinter::switch_off() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
  return result_;
}

std::size_t LivePrinter::Device::read(std::span<char> into) {
  const std::size_t count = PtyHost::read(into);
  if (overhear && count > 0) overhear({into.data(), count});
  return count;
}

}  // namespace lamina::tools
