#include <atomic>
#include <cmath>
#include <exception>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "engine/import/read_model.h"
#include "gcode/marlin/time_text.h"
#include "tools/cli/emulated_printer.h"
#include "tools/cli/failure.h"
#include "tools/cli/file_header.h"
#include "tools/cli/interrupt.h"
#include "tools/cli/json.h"
#include "tools/cli/model_input.h"
#include "tools/cli/print_source.h"
#include "tools/cli/profile_arguments.h"
#include "tools/cli/progress_bar.h"
#include "tools/cli/verbs.h"
#include "transport/emulator/emulator_server.h"
#include "transport/emulator/print_on_emulator.h"
#include "transport/port/memory_port.h"
#include "transport/session/runner.h"

namespace lamina::tools {
namespace {

constexpr double kVolumeTolerance = 0.005;  // of the planned volume: what a faithful printer stays within

struct PrintArguments {
  std::string input;
  std::string port;
  bool emulate = false;
  std::optional<double> time_scale;
  ProfileArguments profile;
  SlicingArguments slicing;
  PlacementArguments placement;
  bool json = false;
  bool quiet = false;
};

/// How a print went, on whatever it was printed.
struct Outcome {
  transport::PrintResult result;
  std::optional<transport::EndReason> end;         ///< Why the conversation ended, where it did.
  std::optional<transport::PrintReport> emulated;  ///< Of the emulated printer.
};

void declare(OptionSet& options, PrintArguments& arguments) {
  options.argument("FILE", arguments.input, "Model, or G-code file (.gcode, .gco, .g, .nc)");
  options.text("--port", arguments.port, "DEVICE", "Printer, such as /dev/ttyUSB0");
  options.flag("--emulate", arguments.emulate,
               "Print on an emulated printer instead, as fast as the machine goes");
  options.number("--time-scale", arguments.time_scale, "N",
                 "With --emulate: N seconds of printing in one second");
  arguments.profile.declare(options);
  arguments.slicing.declare(options);
  arguments.placement.declare(options);
  options.flag("--json", arguments.json, "Print the result as JSON");
  options.flag("--quiet", arguments.quiet, "No progress");
}

void check(const PrintArguments& arguments) {
  if (arguments.emulate == !arguments.port.empty()) {
    throw Failure(ExitCode::kUsage, arguments.emulate ? "--port and --emulate exclude each other"
                                                      : "lamina print needs --port DEVICE or --emulate");
  }
  if (arguments.time_scale && !arguments.emulate)
    throw Failure(ExitCode::kUsage, "--time-scale needs --emulate");
  if (arguments.time_scale && !(*arguments.time_scale > 0.0)) {
    throw Failure(ExitCode::kUsage, "--time-scale must be a number above 0");
  }
}

std::string heater_text(const transport::TemperatureReport& temperatures, const char* name,
                        const char* heater) {
  const transport::HeaterReading* const reading = temperatures.find(heater);
  return reading == nullptr ? ""
                            : fmt::format("  {} {:.0f}/{:.0f} C", name, reading->current, reading->target);
}

/// Empty when the print is over.
std::string phase_name(transport::JobPhase phase) {
  switch (phase) {
    case transport::JobPhase::kConnecting:
      return "Connecting";
    case transport::JobPhase::kPrinting:
      return "Printing";
    case transport::JobPhase::kFinishing:
      return "Finishing";
    case transport::JobPhase::kCancelling:
      return "Cancelling";
    default:
      return {};
  }
}

/// One print: lines from the source, callbacks for the bar, and the flag that stops it.
class Printing {
 public:
  Printing(PrintSource& source, ProgressBar& bar) : source_(source), bar_(bar) {}

  /// The lines. When slicing fails the print is cancelled, heaters off, and `rethrow` tells why.
  transport::LineSource lines() {
    return [this]() -> std::optional<std::string> {
      try {
        if (!stop_) return source_.next();
      } catch (...) {
        error_ = std::current_exception();
        stop_ = true;
      }
      return std::nullopt;
    };
  }

  transport::PrintCallbacks callbacks() {
    transport::PrintCallbacks callbacks;
    callbacks.on_event = [this](const transport::Event& event) {
      if (const auto* ended = std::get_if<transport::Ended>(&event)) end_ = ended->reason;
    };
    callbacks.on_progress = [this](const transport::JobProgress& progress) { show(progress); };
    return callbacks;
  }

  /// Raised by Ctrl-C and by a failure of the source.
  const std::atomic<bool>& stop() {
    if (interrupted_) stop_ = true;
    return stop_;
  }

  bool interrupted() const { return interrupted_; }

  std::optional<transport::EndReason> end() const { return end_; }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void show(const transport::JobProgress& progress) {
    stop();
    if (const std::string phase = phase_name(progress.phase); !phase.empty() && phase != phase_) {
      phase_ = phase;
      bar_.begin(phase);
    }
    std::string detail = fmt::format("line {}", progress.job_lines_acknowledged);
    if (source_.layer_count() > 0)
      detail += fmt::format("  layer {}/{}", source_.layer(), source_.layer_count());
    detail +=
        heater_text(progress.temperatures, "nozzle", "T") + heater_text(progress.temperatures, "bed", "B");
    bar_.update(source_.fraction(), detail);
  }

  PrintSource& source_;
  ProgressBar& bar_;
  std::string phase_;
  const std::atomic<bool>& interrupted_ = defer_interrupts();
  std::atomic<bool> stop_{false};
  std::exception_ptr error_;
  std::optional<transport::EndReason> end_;
};

transport::WireOptions wire(const profiles::Settings& settings) {
  transport::WireOptions options;
  options.baud = settings.port.baud;
  return options;
}

Outcome print_on_port(const std::string& device, const profiles::Settings& settings, Printing& printing) {
  const std::unique_ptr<transport::Port> port = transport::open_port(device, settings.port);
  transport::PrintJob job(printing.lines());
  Outcome outcome;
  outcome.result = transport::run_print(*port, job, printing.callbacks(), printing.stop());
  outcome.end = printing.end();
  return outcome;
}

/// In simulated time.
Outcome print_emulated(const profiles::Settings& settings, Printing& printing) {
  transport::EmulatedPrintOptions options;
  options.emulator = emulated_printer(settings);
  options.to_printer = wire(settings);
  options.to_host = wire(settings);
  options.callbacks = printing.callbacks();
  options.cancelled = [&] { return printing.stop().load(); };
  const transport::EmulatedPrint print = transport::print_on_emulator(printing.lines(), options);
  return {print.result, printing.end(), print.report};
}

/// By the clock, `time_scale` times as fast: the emulated printer lives in a thread of its own.
Outcome print_emulated(const profiles::Settings& settings, Printing& printing, double time_scale) {
  transport::MemoryPorts ports = transport::make_memory_ports();
  transport::EmulatorServerOptions options;
  options.emulator = emulated_printer(settings);
  options.time_scale = time_scale;
  options.to_printer = wire(settings);
  options.to_host = wire(settings);
  std::atomic<bool> stop_emulator{false};
  transport::EmulatorServerResult emulated;
  std::thread emulator([&] { emulated = transport::serve_emulator(*ports.device, options, stop_emulator); });
  transport::PrintJob job(printing.lines());
  Outcome outcome;
  outcome.result = transport::run_print(*ports.host, job, printing.callbacks(), printing.stop());
  outcome.end = printing.end();
  stop_emulator = true;
  emulator.join();
  outcome.emulated = emulated.report;
  return outcome;
}

std::unique_ptr<PrintSource> make_source(const PrintArguments& arguments,
                                         profiles::ResolvedProfile& profile) {
  if (is_gcode_name(arguments.input)) return make_file_source(arguments.input, profile.settings.gcode.limits);
  const engine::ImportResult import = engine::read_model(arguments.input);
  say_warnings(import_warnings(import.report));
  name_print(profile.settings, import.model.name);
  const PlacedModel placed = place(import.model, arguments.placement, profile.settings.gcode.volume);
  return make_model_source(std::make_unique<ModelGcode>(placed, profile.settings));
}

/// Deposited against planned volume: 0.01 = one percent too much.
std::optional<double> volume_error(const Outcome& outcome, const PrintSource& source) {
  if (!outcome.emulated || source.planned_filament() <= 0.0) return std::nullopt;
  return outcome.emulated->filament / source.planned_filament() - 1.0;
}

void say_result(const PrintArguments& arguments, const Outcome& outcome, const PrintSource& source,
                const gcode::FilamentOptions& filament) {
  const transport::JobProgress& progress = outcome.result.progress;
  const double planned = source.planned_filament() * filament.area();
  const std::optional<double> error = volume_error(outcome, source);
  const double seconds = transport::to_seconds(outcome.result.elapsed);
  if (arguments.json) {
    Json json{{"outcome", "completed"},
              {"layers", source.layer()},
              {"lines_sent", progress.job_lines_sent},
              {"lines_acknowledged", progress.job_lines_acknowledged},
              {"lines_sent_again", progress.wire.lines_sent_again},
              {"seconds", seconds},
              {"planned_mm3", planned}};
    if (outcome.emulated) json["emulated"] = to_json(*outcome.emulated);
    if (error) json["volume_error"] = *error;
    std::cout << to_text(json) << '\n';
    return;
  }
  std::cout << fmt::format("completed: {}\n  lines     {} sent, {} acknowledged, {} sent again\n",
                           arguments.input, progress.job_lines_sent, progress.job_lines_acknowledged,
                           progress.wire.lines_sent_again);
  std::cout << fmt::format("  time      {}{}, heating and homing included\n", gcode::duration_text(seconds),
                           outcome.emulated ? " on the emulated printer" : "");
  if (outcome.emulated) std::cout << report_text(*outcome.emulated);
  if (error)
    std::cout << fmt::format("  planned   {:.2f} mm^3: {:+.3f} % deposited\n", planned, 100.0 * *error);
}

ExitCode exit_code(const Outcome& outcome) {
  if (!outcome.end) return ExitCode::kPort;
  switch (*outcome.end) {
    case transport::EndReason::kNotAPrinter:
    case transport::EndReason::kNoAnswer:
      return ExitCode::kPort;
    default:
      return ExitCode::kPrinter;
  }
}

ExitCode run(const PrintArguments& arguments) {
  check(arguments);
  profiles::ResolvedProfile profile = resolve(arguments.profile, arguments.slicing);
  ProgressBar bar(arguments.quiet);
  const std::unique_ptr<PrintSource> source = make_source(arguments, profile);
  Printing printing(*source, bar);
  const profiles::Settings& settings = profile.settings;
  const Outcome outcome = !arguments.emulate     ? print_on_port(arguments.port, settings, printing)
                          : arguments.time_scale ? print_emulated(settings, printing, *arguments.time_scale)
                                                 : print_emulated(settings, printing);
  bar.clear();
  printing.rethrow();
  if (outcome.result.outcome == transport::JobPhase::kCancelled) {
    const std::string what = "cancelled; heaters are off";
    if (printing.interrupted()) throw Interrupted(what);
    throw Failure(ExitCode::kCancelled, what);
  }
  if (outcome.result.outcome == transport::JobPhase::kFailed) {
    throw Failure(exit_code(outcome), outcome.result.failure);
  }
  say_warnings(source->warnings());
  say_result(arguments, outcome, *source, settings.gcode.filament);
  const transport::JobProgress& progress = outcome.result.progress;
  if (progress.job_lines_sent != progress.job_lines_acknowledged) {
    throw Failure(ExitCode::kPrinter, "not every line was acknowledged");
  }
  if (const std::optional<double> error = volume_error(outcome, *source);
      error && std::abs(*error) > kVolumeTolerance) {
    throw Failure(ExitCode::kPrinter,
                  fmt::format("the deposited volume is off by {:+.2f} %", 100.0 * *error));
  }
  return ExitCode::kOk;
}

}  // namespace

Verb print_verb() {
  const auto arguments = std::make_shared<PrintArguments>();
  return {"print", "Print a model or a G-code file on a printer or on an emulated one",
          "  lamina print part.gcode --port /dev/ttyUSB0\n"
          "  lamina print part.igs --port /dev/ttyUSB0 -p ender3 -f petg\n"
          "  lamina print part.igs --emulate\n"
          "  lamina print part.gcode --emulate --time-scale 60",
          [arguments](OptionSet& options) { declare(options, *arguments); },
          [arguments] { return run(*arguments); }};
}

}  // namespace lamina::tools
