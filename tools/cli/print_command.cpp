#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <exception>
#include <filesystem>
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
#include "tools/cli/print_console.h"
#include "tools/cli/print_display.h"
#include "tools/cli/print_journal.h"
#include "tools/cli/print_outcome.h"
#include "tools/cli/print_source.h"
#include "tools/cli/print_trace.h"
#include "tools/cli/profile_arguments.h"
#include "tools/cli/progress_bar.h"
#include "tools/cli/verbs.h"
#include "transport/emulator/emulator_server.h"
#include "transport/emulator/print_on_emulator.h"
#include "transport/port/baud_search.h"
#include "transport/port/memory_port.h"
#include "transport/session/printer_check.h"
#include "transport/session/runner.h"

namespace lamina::tools {
namespace {

constexpr double kMostBaud = 4e6;

struct PrintArguments {
  std::string input;
  std::string port;
  bool emulate = false;
  std::optional<double> time_scale;
  std::optional<double> baud;
  JournalArguments journal;
  std::string console;
  std::string park;
  std::string trace;
  bool force = false;
  bool events = false;
  ProfileArguments profile;
  SlicingArguments slicing;
  PlacementArguments placement;
  bool json = false;
  bool quiet = false;
};

/// Left and back, where the part is seen best; on a round bed at its edge.
std::array<double, 2> parking_place(const gcode::PrintVolume& volume) {
  constexpr double kMargin = 5.0;
  const engine::Box3 box = volume.bounds();
  const double y = box.max().y() - kMargin;
  return {volume.shape == gcode::BedShape::kCircle ? volume.center().x() : box.min().x() + kMargin, y};
}

std::array<double, 2> parse_place(const std::string& text) {
  std::array<double, 2> place{};
  const char* const end = text.data() + text.size();
  const auto x = std::from_chars(text.data(), end, place[0]);
  if (x.ec == std::errc() && x.ptr != end && *x.ptr == ',') {
    const auto y = std::from_chars(x.ptr + 1, end, place[1]);
    if (y.ec == std::errc() && y.ptr == end && std::isfinite(place[0]) && std::isfinite(place[1]))
      return place;
  }
  throw Failure(ExitCode::kUsage, "--park is '" + text + "': it must be two numbers, such as 5,200");
}

transport::PrintJobOptions job_options(const PrintArguments& arguments, const profiles::Settings& settings,
                                       const PrintSource& source) {
  transport::PrintJobOptions options;
  const gcode::PrintVolume& volume = settings.gcode.volume;
  const engine::Box3 box = volume.bounds();
  const gcode::RetractionOptions& retraction = settings.gcode.plan.retraction;
  options.park.place = arguments.park.empty() ? parking_place(volume) : parse_place(arguments.park);
  options.park.highest = box.max().z();
  if (retraction.length > 0.0) options.park.retraction = retraction.length;
  if (retraction.length > 0.0) options.park.retract_speed = retraction.speed;
  std::error_code ignored;
  options.source =
      arguments.input == "-" ? "-" : std::filesystem::absolute(arguments.input, ignored).string();
  options.source_size = source.size();
  options.port = arguments.port;
  if (arguments.force) return options;
  transport::ExpectedPrinter expected;
  expected.volume = transport::ReachedVolume{{box.min().x(), box.min().y(), box.min().z()},
                                             {box.max().x(), box.max().y(), box.max().z()}};
  transport::PrintHeader header = source.header();
  if (!is_gcode_name(arguments.input)) {
    // A model is sliced for the profile's bed.
    header.bed_low = {box.min().x(), box.min().y()};
    header.bed_high = {box.max().x(), box.max().y()};
  }
  options.check = [expected, header](const transport::PrinterFacts& facts) {
    const std::vector<std::string> found = transport::mismatches(header, expected, facts);
    return found.empty()
               ? std::nullopt
               : std::optional(fmt::format("{}; print it anyway with --force", fmt::join(found, "; ")));
  };
  return options;
}

void declare(OptionSet& options, PrintArguments& arguments) {
  options.argument("FILE", arguments.input,
                   "Model, or G-code file (.gcode, .gco, .g, .nc), or - for G-code from standard input");
  options.text("--port", arguments.port, "DEVICE", "Printer, such as /dev/ttyUSB0 or tcp://HOST:PORT");
  options.number("--baud", arguments.baud, "N",
                 "Its speed; 0 tries the usual ones [as -p says, without it 0]");
  options.flag("--emulate", arguments.emulate,
               "Print on an emulated printer instead, as fast as the machine goes");
  options.number(
      "--time-scale", arguments.time_scale, "N",
      "N seconds of printing in one second: with --emulate, or where 'lamina emulate' runs as fast");
  arguments.journal.declare(options);
  options.text("--console", arguments.console, "PIPE",
               "Named pipe to take commands from during the print, as the terminal does ('help' lists them)");
  options.text("--park", arguments.park, "X,Y",
               "Where the nozzle waits in a pause [left and back of the bed]");
  options.text("--trace", arguments.trace, "FILE",
               "Write every byte of the conversation, with its time, for 'lamina replay'");
  options.flag("--force", arguments.force, "Print even if the file seems to be for another printer");
  arguments.profile.declare(options);
  arguments.slicing.declare(options);
  arguments.placement.declare(options);
  options.flag("--json", arguments.json, "Print the result as JSON");
  options.flag("--events", arguments.events, "Tell what happens as JSON, one object a line");
  options.flag("--quiet", arguments.quiet, "No progress");
}

void check(const PrintArguments& arguments) {
  if (arguments.emulate == !arguments.port.empty()) {
    throw Failure(ExitCode::kUsage, arguments.emulate ? "--port and --emulate exclude each other"
                                                      : "lamina print needs --port DEVICE or --emulate");
  }
  if (arguments.baud &&
      (*arguments.baud < 0 || *arguments.baud != std::floor(*arguments.baud) || *arguments.baud > kMostBaud))
    throw Failure(ExitCode::kUsage,
                  "--baud must be a whole number, such as 115200, or 0 to try the usual ones");
  if (!arguments.trace.empty() && arguments.emulate && !arguments.time_scale)
    throw Failure(ExitCode::kUsage, "--trace needs --port, or --emulate with --time-scale");
  if (arguments.baud && arguments.emulate) throw Failure(ExitCode::kUsage, "--baud needs --port");
  arguments.journal.check(arguments.emulate);
  if (arguments.input == "-" && arguments.journal.resume) {
    throw Failure(ExitCode::kUsage, "--resume needs a file: what came through a pipe is gone");
  }
  if (arguments.time_scale && !(*arguments.time_scale > 0.0)) {
    throw Failure(ExitCode::kUsage, "--time-scale must be a number above 0");
  }
}

/// One print: lines from the source, callbacks for the display, and what stops it.
class Printing {
 public:
  Printing(PrintSource& source, PrintDisplay& display, PrintConsole& console)
      : source_(source), display_(display), console_(console) {}

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
    callbacks.on_progress = [this](const transport::JobProgress& progress) { display_.update(progress); };
    return callbacks;
  }

  /// How many lines are there without waiting; none may be missing for a failure to be noticed.
  std::function<transport::SourceLevel()> level() {
    return [this] { return stop_ ? transport::SourceLevel::kPlenty : source_.level(); };
  }

  PrintConsole& console() { return console_; }

  /// Raised by a failure of the source.
  const std::atomic<bool>& stop() const { return stop_; }

  std::optional<transport::EndReason> end() const { return end_; }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  PrintSource& source_;
  PrintDisplay& display_;
  PrintConsole& console_;
  std::atomic<bool> stop_{false};
  std::exception_ptr error_;
  std::optional<transport::EndReason> end_;
};

/// Neither a network connection nor a pseudo-terminal has a speed, or a board that restarts when it is
/// opened.
bool is_serial(const std::string& port) {
  return !port.starts_with("tcp:") && !port.starts_with("/dev/pts/");
}

/// The printer's port, and in `options` the speed that it runs at. That is searched where nobody has said it.
std::unique_ptr<transport::Port> open_printer(const PrintArguments& arguments,
                                              const profiles::Settings& settings,
                                              transport::PrintJobOptions& options) {
  transport::PortOptions port_options = settings.port;
  const bool known = arguments.baud ||
                     arguments.profile.choice.printer != profiles::ProfileChoice{}.printer ||
                     !is_serial(arguments.port);
  if (arguments.baud) port_options.baud = static_cast<int>(*arguments.baud);
  if (!arguments.baud && options.resume && options.resume->baud > 0) port_options.baud = options.resume->baud;
  std::unique_ptr<transport::Port> port = transport::open_port(arguments.port, port_options);
  options.baud = known || options.resume ? port_options.baud : transport::find_baud(*port);
  options.engine.baud = is_serial(arguments.port) ? options.baud : 0;
  return port;
}

transport::WireOptions wire(const profiles::Settings& settings) {
  transport::WireOptions options;
  options.baud = settings.port.baud;
  return options;
}

/// Over a port, by the clock.
PrintOutcome print_on_port(transport::Port& port, Printing& printing, transport::PrintJobOptions job_options,
                           transport::JournalFile* journal, double time_scale) {
  transport::PrintJob job(printing.lines(), std::move(job_options));
  transport::RunOptions options(printing.callbacks());
  options.steer = [&](transport::PrintJob& running, transport::Instant now) {
    printing.console().steer(running, now);
  };
  options.journal = journal;
  options.time_scale = time_scale;
  PrintOutcome outcome;
  outcome.result = transport::run_print(port, job, options, printing.stop());
  outcome.end = printing.end();
  return outcome;
}

/// In simulated time.
PrintOutcome print_emulated(const profiles::Settings& settings, Printing& printing,
                            transport::PrintJobOptions job_options) {
  transport::EmulatedPrintOptions options;
  options.job = std::move(job_options);
  options.job.engine.baud = settings.port.baud;
  options.emulator = emulated_printer(settings);
  options.to_printer = wire(settings);
  options.to_host = wire(settings);
  options.callbacks = printing.callbacks();
  options.steer = [&](transport::PrintJob& job, transport::Instant now) {
    printing.console().steer(job, now);
  };
  options.cancelled = [&] { return printing.stop().load(); };
  const transport::EmulatedPrint print = transport::print_on_emulator(printing.lines(), options);
  return {print.result, printing.end(), print.report};
}

/// By the clock, `time_scale` times as fast: the emulated printer lives in a thread of its own.
PrintOutcome print_emulated(const profiles::Settings& settings, Printing& printing,
                            transport::PrintJobOptions job_options, double time_scale,
                            const std::string& trace_path) {
  transport::MemoryPorts ports = transport::make_memory_ports();
  job_options.engine.baud = settings.port.baud;
  PrintTrace trace(trace_path, *ports.host, job_options.engine, 1);
  transport::EmulatorServerOptions options;
  options.emulator = emulated_printer(settings);
  options.time_scale = time_scale;
  options.to_printer = wire(settings);
  options.to_host = wire(settings);
  std::atomic<bool> stop_emulator{false};
  transport::EmulatorServerResult emulated;
  std::thread emulator([&] { emulated = transport::serve_emulator(*ports.device, options, stop_emulator); });
  PrintOutcome outcome = print_on_port(trace.port(), printing, std::move(job_options), nullptr, 1);
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
  const PlacedModel placed = place({import.model}, arguments.placement, profile.settings.gcode.volume);
  return make_model_source(std::make_unique<ModelGcode>(placed, profile.settings));
}

/// What to do after a failure, where the journal helps.
std::string resume_hint(const PrintJournal& journal, const PrintOutcome& outcome) {
  if (journal.file == nullptr || outcome.result.progress.job_lines_acknowledged == 0) return {};
  return fmt::format("the same command with --resume goes on with it ({})", journal.file->path().string());
}

PrintOutcome print(const PrintArguments& arguments, const profiles::Settings& settings,
                   const PrintSource& source, Printing& printing, PrintJournal& journal) {
  transport::PrintJobOptions options = job_options(arguments, settings, source);
  if (arguments.emulate) {
    return arguments.time_scale ? print_emulated(settings, printing, std::move(options),
                                                 *arguments.time_scale, arguments.trace)
                                : print_emulated(settings, printing, std::move(options));
  }
  options.source_level = printing.level();
  if (!is_serial(arguments.port)) options.engine.start_wait = std::chrono::milliseconds(50);
  options.resume = std::move(journal.left);
  options.resume_after_restart = arguments.journal.after_restart;
  const std::unique_ptr<transport::Port> port = open_printer(arguments, settings, options);
  const double time_scale = arguments.time_scale.value_or(1.0);
  PrintTrace trace(arguments.trace, *port, options.engine, time_scale);
  return print_on_port(trace.port(), printing, std::move(options), journal.file.get(), time_scale);
}

ExitCode run(const PrintArguments& arguments) {
  check(arguments);
  profiles::ResolvedProfile profile = resolve(arguments.profile, arguments.slicing);
  ProgressBar bar(arguments.quiet);
  const std::unique_ptr<PrintSource> source = make_source(arguments, profile);
  const profiles::Settings& settings = profile.settings;
  PrintJournal journal;
  if (!arguments.emulate)
    journal = open_journal(arguments.journal, arguments.input, source->size(), arguments.port);
  PrintDisplay display(*source, bar, transport::Window{}, arguments.events);
  // Nobody types fast enough for simulated time.
  const bool simulated = arguments.emulate && !arguments.time_scale;
  PrintConsole console(simulated || arguments.input == "-", arguments.console,
                       [&](const std::string& text) { display.say(text); });
  Printing printing(*source, display, console);
  if (!journal.forgotten.empty())
    say_warnings({"the unfinished print of " + journal.forgotten + " can no longer be resumed"});
  const PrintOutcome outcome = print(arguments, settings, *source, printing, journal);
  bar.clear();
  printing.rethrow();
  if (outcome.result.outcome == transport::JobPhase::kCancelled) {
    const bool by_printer = outcome.result.cancelled_by == transport::Instigator::kPrinter;
    const std::string what = "cancelled; heaters are off";
    if (console.interrupted() && !by_printer) throw Interrupted(what);
    throw Failure(ExitCode::kCancelled, by_printer ? "cancelled at the printer; heaters are off" : what);
  }
  if (outcome.result.outcome == transport::JobPhase::kFailed) {
    throw Failure(exit_code(outcome), outcome.result.failure, resume_hint(journal, outcome));
  }
  say_warnings(source->warnings());
  say_outcome({arguments.input, arguments.json}, outcome, *source, settings.gcode.filament);
  refuse_faults(outcome, *source);
  return ExitCode::kOk;
}

}  // namespace

Verb print_verb() {
  const auto arguments = std::make_shared<PrintArguments>();
  return {"print", "Print a model or a G-code file on a printer or on an emulated one",
          "  lamina print part.gcode --port /dev/ttyUSB0\n"
          "  lamina print part.igs --port /dev/ttyUSB0 -p ender3 -f petg\n"
          "  lamina print part.igs --emulate\n"
          "  lamina print part.gcode --emulate --time-scale 60\n"
          "  lamina print part.gcode --port /dev/ttyUSB0 --resume     after the host or the cable failed\n"
          "  lamina slice part.igs -o - | lamina print - --port /dev/ttyUSB0",
          [arguments](OptionSet& options) { declare(options, *arguments); },
          [arguments] { return run(*arguments); }};
}

}  // namespace lamina::tools
