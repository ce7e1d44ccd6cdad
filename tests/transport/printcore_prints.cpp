// Runs an emulated printer on a pseudo-terminal for a foreign host: prints the path on the first line, lives
// until its input ends, then prints what was deposited. `--flip RATE` damages bytes on the way to the
// printer.

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>

#include "transport/emulator/emulator_server.h"
#include "transport/port/pty_host.h"

int main(int argc, char** argv) {
  using namespace lamina::transport;
  EmulatorServerOptions options;
  options.time_scale = 50;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--flip") == 0)
      options.to_printer.faults.flip = std::strtod(argv[i + 1], nullptr);
  }
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
