// How well the wire is used: lines a second and share of the wire's limit on the emulator's wire model, with
// the window and with one line at a time; what that does to the motion; and the same file over a
// pseudo-terminal in real time, by lamina's host and by Printrun's printcore.

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tools/bench/wire_runs.h"
#include "transport/emulator/emulator_server.h"
#include "transport/port/pty_host.h"
#include "transport/session/runner.h"

namespace {

using namespace lamina::tools;
using namespace lamina::transport;

/// What is promised of the window.
constexpr double kShareToHold = 0.97;
constexpr double kMeatpackGain = 1.5;
constexpr double kPrintcoreGain = 1.5;

std::vector<WireCase> links(bool quick) {
  if (quick) return {{115200, {}, false}, {250000, {}, true}};
  std::vector<WireCase> cases;
  for (const int baud : {115200, 250000}) {
    for (const bool advanced : {false, true}) {
      for (const int latency : {0, 1, 16})
        cases.push_back({baud, std::chrono::milliseconds(latency), advanced});
    }
  }
  return cases;
}

std::string name(const WireCase& wire) {
  return fmt::format("{:>6} {:<8} {:>2} ms", wire.baud, wire.advanced_ok ? "advanced" : "plain",
                     wire.latency / std::chrono::milliseconds(1));
}

/// Prints the table of the wire's use; how many promises were broken.
int print_wire_table(int chords, bool quick) {
  int broken = 0;
  const std::vector<std::string> lines = circle_of_chords(chords, 2000);
  fmt::print(
      "{} chords of 0.2 mm on a machine that never waits; lines/s, and share of what the wire carries\n\n"
      "{:<21} {:>13} {:>15} {:>15} {:>18} {:>9}\n",
      chords, "link", "one at a time", "window", "MeatPack", "MeatPack, one each", "overruns");
  for (WireCase wire : links(quick)) {
    std::vector<WireUse> uses;
    for (const bool meatpack : {false, true}) {
      for (const bool window : {false, true}) {
        wire.meatpack = meatpack;
        wire.window = window;
        uses.push_back(measure_wire(lines, wire));
      }
    }
    const WireUse& plain = uses[1];
    const WireUse& packed = uses[3];
    std::int64_t lost = 0;
    for (const WireUse& use : uses) lost += use.bytes_lost;
    const auto cell = [](const WireUse& use) {
      return fmt::format("{:.0f} ({:.0f} %)", use.lines_per_second, 100 * use.share());
    };
    std::string verdict;
    if (lost > 0) verdict += " OVERRUN";
    if (wire.latency == Duration{} && (plain.share() < kShareToHold || packed.share() < kShareToHold))
      verdict += " below 97 %";
    if (packed.lines_per_second < kMeatpackGain * plain.lines_per_second &&
        wire.latency < std::chrono::milliseconds(16))
      verdict += fmt::format(" MeatPack only x {:.2f}", packed.lines_per_second / plain.lines_per_second);
    broken += verdict.empty() ? 0 : 1;
    fmt::print("{:<21} {:>13} {:>15} {:>15} {:>18} {:>9}{}\n", name(wire), cell(uses[0]), cell(plain),
               cell(packed), cell(uses[2]), lost, verdict);
  }
  return broken;
}

/// Prints the table of what becomes of the motion; how many promises were broken.
int print_motion_table(int chords, bool quick) {
  int broken = 0;
  constexpr double kSpeed = 60;
  const std::vector<std::string> lines = circle_of_chords(chords, kSpeed);
  const double demand = kSpeed / 0.2;
  fmt::print(
      "\n{} chords of 0.2 mm at {} mm/s, {:.0f} lines/s wanted: underruns, and s of motion\n\n"
      "{:<21} {:>17} {:>17} {:>17} {:>26}\n",
      chords, kSpeed, demand, "link", "one at a time", "window", "MeatPack", "lost by window, as told");
  const double least = measure_motion(lines, {250000, {}, false}).moving;
  for (WireCase wire : links(quick)) {
    wire.window = false;
    const WireUse single = measure_motion(lines, wire);
    wire.window = true;
    const WireUse plain = measure_motion(lines, wire);
    wire.meatpack = true;
    const WireUse packed = measure_motion(lines, wire);
    const auto cell = [](const WireUse& use) {
      return fmt::format("{:>4} {:>8.2f} s", use.underruns, use.moving);
    };
    const bool suffices = plain.limit > demand && wire.latency == Duration{};
    const bool failed = suffices && plain.underruns > 0;
    broken += failed ? 1 : 0;
    fmt::print("{:<21} {:>17} {:>17} {:>17} {:>10.2f} s as {:>6.2f} s{}\n", name(wire), cell(single),
               cell(plain), cell(packed), plain.moving - least, plain.told_starved,
               failed ? " UNDERRUN" : "");
  }
  return broken;
}

/// An emulated printer behind a pseudo-terminal, in real time, as long as it lives.
class ServedPrinter {
 public:
  explicit ServedPrinter(const WireCase& wire) {
    options_.emulator = tireless_printer(wire);
    options_.to_printer.baud = options_.to_host.baud = wire.baud;
    options_.to_host.latency = wire.latency;
    options_.to_host.packet = wire.latency > Duration{} ? 62 : 0;
    thread_ = std::thread([this] { serve_emulator(device_, options_, stop_); });
  }
  ServedPrinter(const ServedPrinter&) = delete;
  ServedPrinter& operator=(const ServedPrinter&) = delete;
  ~ServedPrinter() {
    stop_ = true;
    thread_.join();
  }

  const std::string& path() const { return device_.path(); }

 private:
  PtyHost device_;
  EmulatorServerOptions options_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

double rate_of_lamina(const WireCase& wire, const std::vector<std::string>& lines) {
  ServedPrinter printer(wire);
  const auto port = open_port(printer.path(), {});
  PrintJobOptions options;
  options.engine.baud = wire.baud;
  options.engine.start_wait = std::chrono::milliseconds(300);
  options.temperature_interval = Duration{};
  PrintJob job(
      [&lines, next = std::size_t{0}]() mutable -> std::optional<std::string> {
        if (next == lines.size()) return std::nullopt;
        return lines[next++];
      },
      options);
  std::optional<std::chrono::steady_clock::time_point> first;
  std::chrono::steady_clock::time_point last;
  std::size_t moves = 0;
  PrintCallbacks callbacks;
  callbacks.on_event = [&](const Event& event) {
    const auto* acknowledged = std::get_if<LineAcknowledged>(&event);
    if (!acknowledged || acknowledged->line.command.find(" E") == std::string::npos) return;
    last = std::chrono::steady_clock::now();
    if (!first) first = last;
    ++moves;
  };
  const std::atomic<bool> cancel = false;
  const PrintResult result = run_print(*port, job, RunOptions(callbacks), cancel);
  if (result.outcome != JobPhase::kCompleted) throw std::runtime_error(result.failure);
  return static_cast<double>(moves - 1) / std::chrono::duration<double>(last - *first).count();
}

/// None where Printrun is not installed.
std::optional<double> rate_of_printcore(const WireCase& wire, const std::vector<std::string>& lines,
                                        const std::string& script) {
  ServedPrinter printer(wire);
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("lamina_wire_{}.gcode", wire.baud);
  {
    std::ofstream out(file);
    for (const std::string& line : lines) out << line << '\n';
  }
  const std::string command =
      fmt::format("/usr/bin/python3 {} {} {} {}", script, printer.path(), wire.baud, file.string());
  FILE* pipe = ::popen(command.c_str(), "r");
  if (!pipe) return std::nullopt;
  double moves = 0;
  double seconds = 0;
  const int read = std::fscanf(pipe, "%lf %lf", &moves, &seconds);
  ::pclose(pipe);
  std::filesystem::remove(file);
  if (read != 2 || seconds <= 0) return std::nullopt;
  return moves / seconds;
}

/// The same in real time, against a foreign host; how many promises were broken.
int print_real_time_table(int chords, const std::string& script) {
  int broken = 0;
  const std::vector<std::string> lines = circle_of_chords(chords, 2000);
  fmt::print(
      "\nthe same over a pseudo-terminal in real time, {} chords; lines/s\n\n{:<21} {:>10} {:>10} {:>8}\n",
      chords, "link", "printcore", "lamina", "times");
  for (const WireCase& wire : std::vector<WireCase>{{115200, {}, false},
                                                    {250000, {}, false},
                                                    {250000, {}, true},
                                                    {250000, std::chrono::milliseconds(1), true}}) {
    const std::optional<double> printcore = rate_of_printcore(wire, lines, script);
    const double own = rate_of_lamina(wire, lines);
    if (!printcore) {
      fmt::print("{:<21} {:>10} {:>10.0f}\n", name(wire), "(none)", own);
      continue;
    }
    const bool failed = own < kPrintcoreGain * *printcore;
    broken += failed ? 1 : 0;
    fmt::print("{:<21} {:>10.0f} {:>10.0f} {:>8.2f}{}\n", name(wire), *printcore, own, own / *printcore,
               failed ? " below 1.5" : "");
  }
  return broken;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("How well the serial wire is used");
  bool quick = false;
  int chords = 4000;
  app.add_flag("--quick", quick, "two links, and nothing in real time");
  app.add_option("--chords", chords, "moves of each print");
  CLI11_PARSE(app, argc, argv);
  try {
    int broken = print_wire_table(chords, quick);
    broken += print_motion_table(chords / 2, quick);
    if (!quick) broken += print_real_time_table(chords, LAMINA_PRINTCORE_RATE);
    return broken == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
