#include <atomic>
#include <chrono>
#include <iostream>
#include <memory>

#include "tools/cli/emulated_printer.h"
#include "tools/cli/failure.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/json.h"
#include "tools/cli/profile_arguments.h"
#include "tools/cli/verbs.h"
#include "transport/emulator/emulator_server.h"
#include "transport/port/pty_host.h"

namespace lamina::tools {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kQuietAfterPrint{3};

struct EmulateArguments {
  ProfileArguments profile;
  double time_scale = 1.0;
  bool once = false;
  bool json = false;
};

/// Tells when a print is over: something was extruded, and since then no command has run for some seconds.
class PrintWatch {
 public:
  bool is_over(const transport::Emulator& emulator) {
    const Clock::time_point now = Clock::now();
    if (emulator.report().lines_run != lines_run_ || !emulator.idle()) {
      lines_run_ = emulator.report().lines_run;
      last_sign_ = now;
    }
    return emulator.report().beads > 0 && now - last_sign_ >= kQuietAfterPrint;
  }

 private:
  std::int64_t lines_run_ = 0;
  Clock::time_point last_sign_ = Clock::now();
};

ExitCode run(const EmulateArguments& arguments) {
  if (!(arguments.time_scale > 0.0)) throw Failure(ExitCode::kUsage, "--time-scale must be a number above 0");
  const profiles::Settings settings = resolve(arguments.profile).settings;
  transport::PtyHost device;
  std::cout << device.path() << std::endl;
  std::cerr << "The emulated printer listens there; Ctrl-C ends it.\n";

  const std::atomic<bool>& interrupted = defer_interrupts();
  std::atomic<bool> stop{false};
  PrintWatch watch;
  transport::EmulatorServerOptions options;
  options.emulator = emulated_printer(settings);
  options.time_scale = arguments.time_scale;
  options.on_progress = [&](const transport::Emulator& emulator) {
    stop = interrupted || (arguments.once && watch.is_over(emulator));
  };
  const transport::EmulatorServerResult result = transport::serve_emulator(device, options, stop);
  if (arguments.json) {
    std::cout << to_line(to_json(result.report)) << '\n';
  } else {
    std::cout << report_text(result.report);
  }
  return ExitCode::kOk;
}

}  // namespace

Verb emulate_verb() {
  const auto arguments = std::make_shared<EmulateArguments>();
  return {"emulate", "Run an emulated printer behind a pseudo-terminal that any host can open",
          "  lamina emulate                      prints the path to open, such as /dev/pts/3\n"
          "  lamina emulate --time-scale 60      a minute a second\n"
          "  lamina emulate -p prusa_mk3s --once --json",
          [arguments](OptionSet& options) {
            arguments->profile.declare(options);
            options.number("--time-scale", arguments->time_scale, "N",
                           "N seconds for the printer in one second [1]");
            options.flag("--once", arguments->once, "End when a print has ended");
            options.flag("--json", arguments->json, "Print the report as JSON, in one line");
          },
          [arguments] { return run(*arguments); }};
}

}  // namespace lamina::tools
