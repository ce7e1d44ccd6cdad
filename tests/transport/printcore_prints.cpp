// Runs an emulated printer on a pseudo-terminal for a foreign host: prints the path on the first line, lives
// until its input ends, then prints what was deposited. Every argument is a fault to order.

#include <atomic>
#include <cstdio>
#include <exception>
#include <string>
#include <thread>

#include "transport/emulator/emulator_server.h"
#include "transport/emulator/fault_order.h"
#include "transport/port/pty_host.h"

int main(int argc, char** argv) {
  using namespace lamina::transport;
  EmulatorServerOptions options;
  options.time_scale = 50;
  try {
    for (int i = 1; i < argc; ++i) options.emulator.faults.push_back(parse_fault_order(argv[i]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  give_to_wires(options.emulator.faults, options.to_printer.faults, options.to_host.faults);
  options.to_printer.faults.spacing = 200;

  PtyHost device;
  std::printf("%s\n", device.path().c_str());
  std::fflush(stdout);

  std::atomic<bool> stop = false;
  std::thread until_input_ends([&stop] {
    while (std::getchar() != EOF) {
    }
    stop = true;
  });
  const EmulatorServerResult result = serve_emulator(device, options, stop);
  until_input_ends.join();
  const PrintReport& report = result.report;
  std::printf("beads %lld filament %.5f refused %lld duplicates %lld\n", static_cast<long long>(report.beads),
              report.filament, static_cast<long long>(report.refused_lines),
              static_cast<long long>(report.duplicate_lines));
  return 0;
}
