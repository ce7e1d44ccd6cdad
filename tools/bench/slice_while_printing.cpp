// Prints a model on an emulated printer while it is being sliced, by the real program through a
// pseudo-terminal: how soon the first move is at the port, how much memory it takes, and whether the same is
// deposited as by slicing first and printing then.

#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "tools/bench/host_process.h"
#include "tools/bench/live_printer.h"

namespace {

namespace fs = std::filesystem;
using namespace lamina;
using Clock = std::chrono::steady_clock;

constexpr double kLongest = 3600;  // s

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Finds the first line that moves X or Y in what goes over the wire.
class FirstMove {
 public:
  explicit FirstMove(Clock::time_point begin) : begin_(begin) {}

  void overhear(std::string_view bytes) {
    if (found_ > 0) return;
    text_ += bytes;
    for (std::size_t end = text_.find('\n'); end != std::string::npos; end = text_.find('\n')) {
      const std::string line = text_.substr(0, end);
      text_.erase(0, end + 1);
      const bool moves = (line.find("G1X") != std::string::npos || line.find("G1 X") != std::string::npos);
      if (moves && found_ == 0) found_ = seconds_since(begin_);
    }
  }
  double seconds() const { return found_; }

 private:
  Clock::time_point begin_;
  std::string text_;
  std::atomic<double> found_{0};
};

struct Run {
  double first_move = 0;  // s from the start of the program
  double seconds = 0;
  long memory = 0;  // bytes
  std::vector<transport::Bead> beads;
  transport::PrintReport report;
};

struct Options {
  std::string program = LAMINA_PROGRAM;
  std::string model = LAMINA_MODEL;
  std::vector<std::string> arguments;
  double time_scale = 500;
};

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

Run print(const Options& options, const std::string& input, bool slices, const fs::path& folder) {
  transport::MotionOptions motion;
  motion.bed_max = {220, 220, 250};
  const Clock::time_point begin = Clock::now();
  FirstMove first(begin);
  tools::LivePrinter printer(options.time_scale, motion,
                             [&](std::string_view bytes) { first.overhear(bytes); });
  std::vector<std::string> command{options.program,
                                   "print",
                                   input,
                                   "--port",
                                   printer.path(),
                                   "--time-scale",
                                   fmt::format("{}", options.time_scale),
                                   "--quiet",
                                   "--no-journal"};
  if (slices) command.insert(command.end(), options.arguments.begin(), options.arguments.end());
  tools::HostProcess host(command, folder / "messages");
  if (host.wait(kLongest) != 0) throw std::runtime_error("the print failed: " + text_of(folder / "messages"));
  Run run{first.seconds(), seconds_since(begin), host.peak_memory(), {}, {}};
  const transport::EmulatorServerResult& result = printer.switch_off();
  run.beads = result.beads;
  run.report = result.report;
  return run;
}

int measure(const Options& options, double most_seconds, double most_memory) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("lamina_slice_print_{}", ::getpid());
  fs::create_directories(folder);
  const fs::path gcode = folder / "sliced.gcode";
  std::vector<std::string> slice{options.program, "slice", options.model, "-o", gcode.string()};
  slice.insert(slice.end(), options.arguments.begin(), options.arguments.end());
  tools::HostProcess slicer(slice, folder / "messages");
  if (slicer.wait(kLongest) != 0) throw std::runtime_error("slicing failed: " + text_of(folder / "messages"));
  const Run together = print(options, options.model, true, folder);
  const Run apart = print(options, gcode.string(), false, folder);
  fs::remove_all(folder);
  // What was pushed out while parked for the slicer lies on the spot.
  std::vector<transport::Bead> beads;
  for (const transport::Bead& bead : together.beads) {
    if (bead.from != bead.to) beads.push_back(bead);
  }
  std::vector<transport::Bead> expected;
  for (const transport::Bead& bead : apart.beads) {
    if (bead.from != bead.to) expected.push_back(bead);
  }
  constexpr double kMebibyte = 1024.0 * 1024.0;
  const double memory = static_cast<double>(together.memory) / kMebibyte;
  const bool same = beads == expected;
  fmt::print("{}\n", options.model);
  fmt::print(
      "first move at the port  {:.3f} s from the start of the program (slicing first: {:.3f} s to print)\n",
      together.first_move, apart.first_move);
  fmt::print("peak memory             {:.1f} MiB (printing a file: {:.1f} MiB)\n", memory,
             static_cast<double>(apart.memory) / kMebibyte);
  fmt::print("deposited               {} beads, {}\n", beads.size(),
             same ? "the same as slicing first"
                  : fmt::format("NOT the same as slicing first ({})", expected.size()));
  fmt::print("whole print             {:.1f} s, {} underruns, at {} times the speed\n", together.seconds,
             together.report.underruns, options.time_scale);
  return same && together.first_move <= most_seconds && memory <= most_memory ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  double most_seconds = 1e9;
  double most_memory = 1e9;
  bool quick = false;
  CLI::App app("Measures printing while slicing", "slice_while_printing");
  app.add_option("--lamina", options.program, "The program");
  app.add_option("--model", options.model, "What is printed");
  app.add_option("--time-scale", options.time_scale, "Seconds in one second")->capture_default_str();
  app.add_option("--most-seconds", most_seconds, "Fail if the first move comes later");
  app.add_option("--most-memory", most_memory, "Fail above so many MiB");
  app.add_flag("--quick", quick, "A small box");
  app.add_option("arguments", options.arguments, "For lamina, behind --");
  CLI11_PARSE(app, argc, argv);
  if (quick) {
    options.model = LAMINA_BOX;
    options.arguments = {"--scale", "0.3"};
  }
  try {
    return measure(options, most_seconds, most_memory);
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 2;
  }
}
