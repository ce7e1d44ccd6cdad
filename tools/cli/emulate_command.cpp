#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli/emulated_printer.h"
#include "tools/cli/failure.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/json.h"
#include "tools/cli/profile_arguments.h"
#include "tools/cli/verbs.h"
#include "transport/emulator/emulator_server.h"
#include "transport/emulator/fault_order.h"
#include "transport/port/pty_host.h"
#include "transport/port/tcp_host.h"

namespace lamina::tools {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kQuietAfterPrint{3};

/// Bytes of payload in a packet of the usual USB adapter.
constexpr std::size_t kUsbPacket = 62;

struct EmulateArguments {
  ProfileArguments profile;
  double time_scale = 1.0;
  bool once = false;
  bool json = false;
  std::optional<double> tcp_port;
  int baud = 0;
  double latency = 0;
  std::vector<std::string> features;
  std::vector<std::string> faults;
  int seed = 1;
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

/// The printer's end of what a host opens.
std::unique_ptr<transport::Port> open_device(const EmulateArguments& arguments) {
  if (!arguments.tcp_port) return std::make_unique<transport::PtyHost>();
  const double port = *arguments.tcp_port;
  if (!(port >= 0 && port <= 65535) || port != std::floor(port))
    throw Failure(ExitCode::kUsage, "--tcp takes a port number up to 65535, 0 for any that is free");
  return std::make_unique<transport::TcpHost>(transport::TcpAddress{"127.0.0.1", static_cast<int>(port)});
}

/// What the command line says of the wires, the firmware and what is to go wrong.
void apply(const EmulateArguments& arguments, transport::EmulatorServerOptions& options) {
  if (!(arguments.latency >= 0)) throw Failure(ExitCode::kUsage, "--latency must be a number of 0 or more");
  options.to_printer.baud = options.to_host.baud = arguments.baud;
  // A serial line loses what its receiver has no room for.
  if (arguments.baud > 0) options.emulator.serial.overflow = transport::Overflow::kLose;
  options.to_host.latency = transport::from_seconds(arguments.latency / 1000);
  options.to_host.packet = arguments.latency > 0 ? kUsbPacket : 0;
  for (const std::string& list : arguments.features) {
    for (std::size_t begin = 0; begin <= list.size();) {
      const std::size_t end = std::min(list.find(',', begin), list.size());
      switch_feature(options.emulator.features, list.substr(begin, end - begin));
      begin = end + 1;
    }
  }
  try {
    for (const std::string& fault : arguments.faults)
      options.emulator.faults.push_back(transport::parse_fault_order(fault));
  } catch (const transport::FaultOrderError& error) {
    throw Failure(ExitCode::kUsage, error.what());
  }
  const auto seed = static_cast<std::uint64_t>(arguments.seed);
  options.to_printer.faults.seed = options.emulator.fault_seed = seed;
  options.to_host.faults.seed = seed + 1;
  transport::give_to_wires(options.emulator.faults, options.to_printer.faults, options.to_host.faults);
}

ExitCode run(const EmulateArguments& arguments) {
  if (!(arguments.time_scale > 0.0)) throw Failure(ExitCode::kUsage, "--time-scale must be a number above 0");
  const profiles::Settings settings = resolve(arguments.profile).settings;
  transport::EmulatorServerOptions options;
  options.emulator = emulated_printer(settings);
  apply(arguments, options);
  const std::unique_ptr<transport::Port> device = open_device(arguments);
  std::cout << device->name() << std::endl;
  std::cerr << "The emulated printer listens there; Ctrl-C ends it.\n";

  const std::atomic<bool>& interrupted = defer_interrupts();
  std::atomic<bool> stop{false};
  PrintWatch watch;
  options.time_scale = arguments.time_scale;
  options.on_progress = [&](const transport::Emulator& emulator) {
    stop = interrupted || (arguments.once && watch.is_over(emulator));
  };
  const transport::EmulatorServerResult result = transport::serve_emulator(*device, options, stop);
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
  return {
      "emulate", "Run an emulated printer behind a pseudo-terminal that any host can open",
      "  lamina emulate                      prints the path to open, such as /dev/pts/3\n"
      "  lamina emulate --time-scale 60      a minute a second\n"
      "  lamina emulate --tcp 2217           prints tcp://127.0.0.1:2217\n"
      "  lamina emulate -p prusa_mk3s --once --json\n"
      "  lamina emulate --baud 115200 --firmware advanced-ok,meatpack --fault flip@chance:0.001\n"
      "  lamina emulate --fault lose-ok@line:50 --fault stall=5@time:30\n"
      "\n"
      "Firmware features, no- before one switches it off:\n  " +
          firmware_feature_names() +
          "\n\nFaults, KIND@WHEN or KIND=HOW@WHEN, once at line:N, command:N, byte:N, time:SECONDS or again\n"
          "and again by chance:P:\n" +
          transport::fault_order_help(),
      [arguments](OptionSet& options) {
        arguments->profile.declare(options);
        options.number("--time-scale", arguments->time_scale, "N",
                       "N seconds for the printer in one second [1]");
        options.number("--tcp", arguments->tcp_port, "PORT",
                       "Listen at a TCP port of this machine instead of a pseudo-terminal");
        options.count("--baud", arguments->baud, "N",
                      "Let the bytes take the time of a serial line, and lose what overflows [no time]");
        options.number("--latency", arguments->latency, "MS",
                       "Of what the printer says, as through a USB adapter [0]");
        options.texts("--firmware", arguments->features, "LIST", "What the firmware can do, see below");
        options.texts("--fault", arguments->faults, "FAULT", "Something that goes wrong, see below");
        options.count("--seed", arguments->seed, "N", "Of the faults by chance [1]");
        options.flag("--once", arguments->once, "End when a print has ended");
        options.flag("--json", arguments->json, "Print the report as JSON, in one line");
      },
      [arguments] { return run(*arguments); }};
}

}  // namespace lamina::tools
