// Tries prints under random faults, and tells what came of them. Every print must complete or, where a fault
// ends it, say why; with one line in flight it must deposit what the fault-free print deposits, bead for
// bead; with a window it may differ only by commands that the firmware made up from cut lines, and these must
// be noticed.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tools/bench/fault_campaign.h"

namespace {

using namespace lamina::tools;

std::vector<std::string> read_lines(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

/// What went over the wire, as the protocol engine tells it.
void print_event(const lamina::transport::Event& event) {
  using namespace lamina::transport;
  if (const auto* sent = std::get_if<LineSent>(&event))
    fmt::print("  > N{} {}{}\n", sent->line.number, sent->line.command, sent->again ? " (again)" : "");
  if (const auto* acknowledged = std::get_if<LineAcknowledged>(&event))
    fmt::print("    N{} acknowledged\n", acknowledged->line.number);
  if (const auto* resend = std::get_if<ResendRequested>(&event))
    fmt::print("    back to N{}: {}\n", resend->number, resend->reason);
  if (std::holds_alternative<ProbeStarted>(event)) fmt::print("    probe\n");
  if (const auto* stray = std::get_if<StrayReply>(&event)) fmt::print("    stray: {}\n", stray->text);
  if (const auto* ended = std::get_if<Ended>(&event)) fmt::print("    ended: {}\n", ended->detail);
  if (const auto* received = std::get_if<ReplyReceived>(&event)) {
    const Reply& reply = received->reply;
    if (const auto* ok = std::get_if<OkReply>(&reply))
      fmt::print("  < ok{}\n", ok->number ? fmt::format(" N{}", *ok->number) : ok->temperatures ? " T" : "");
    if (const auto* request = std::get_if<ResendReply>(&reply))
      fmt::print("  < Resend {}\n", request->number);
    if (const auto* error = std::get_if<ErrorReply>(&reply)) fmt::print("  < Error {}\n", error->text);
    if (const auto* text = std::get_if<TextReply>(&reply)) fmt::print("  < {}\n", text->text);
    if (const auto* unknown = std::get_if<UnknownCommandReply>(&reply))
      fmt::print("  < unknown {}\n", unknown->command);
    if (std::holds_alternative<StartReply>(reply)) fmt::print("  < start\n");
    if (std::holds_alternative<BusyReply>(reply)) fmt::print("  < busy\n");
  }
}

/// Sums over prints with the same window.
struct Tally {
  std::int64_t prints = 0, completed = 0, exact = 0, ended = 0, errors = 0, stray_commands = 0,
               stray_moves = 0, strays_reported = 0, bytes = 0, violations = 0;
  double longest = 0;  ///< simulated s

  void add(const FaultVerdict& verdict) {
    ++prints;
    completed += verdict.completed ? 1 : 0;
    ended += verdict.completed ? 0 : 1;
    exact += verdict.completed && verdict.same_beads ? 1 : 0;
    errors += verdict.errors;
    stray_commands += verdict.stray_commands;
    stray_moves += verdict.stray_moves;
    strays_reported += verdict.strays_reported;
    bytes += verdict.bytes;
    violations += verdict.violation.empty() ? 0 : 1;
    longest = std::max(longest, verdict.seconds);
  }
};

void print_tally(const std::string& name, const Tally& tally) {
  const double per_errors = tally.errors > 0 ? 1e4 / static_cast<double>(tally.errors) : 0;
  fmt::print("{:<19} {:>7} {:>9} {:>9} {:>7} {:>8} {:>8} {:>7} {:>9.2f} {:>9} {:>7.0f} {:>6}\n", name,
             tally.prints, tally.completed, tally.exact, tally.ended, tally.errors, tally.stray_commands,
             tally.stray_moves, static_cast<double>(tally.stray_moves) * per_errors, tally.strays_reported,
             tally.longest, tally.violations);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Prints under random faults on the emulated printer");
  std::vector<std::string> files;
  std::uint64_t prints = 10000;
  std::uint64_t first_seed = 1;
  double highest_rate = 1e-2;
  std::size_t length = 300;
  bool quick = false;
  bool explain = false;
  bool talk = false;
  app.add_option("--gcode", files, "G-code files to cut prints from [a small one of lamina's]");
  app.add_option("--prints", prints, "how many schedules to try");
  app.add_option("--seed", first_seed, "the first schedule's seed");
  app.add_option("--rate", highest_rate, "highest chance of damage to a byte");
  app.add_option("--lines", length, "lines of each print");
  app.add_flag("--quick", quick, "200 schedules");
  app.add_flag("--talk", talk, "every line and reply");
  app.add_flag("--explain", explain, "every schedule and what came of it");
  CLI11_PARSE(app, argc, argv);
  if (quick) prints = 200;
  if (files.empty()) files.emplace_back(LAMINA_GCODE_SAMPLE);

  try {
    std::vector<ShortPrint> shorts;
    for (const std::string& file : files) {
      for (ShortPrint& print : short_prints(read_lines(file), 12, length)) shorts.push_back(std::move(print));
    }
    const auto start = std::chrono::steady_clock::now();
    std::map<std::string, Tally> tallies;
    for (std::uint64_t seed = first_seed; seed < first_seed + prints; ++seed) {
      const std::size_t window = seed % 2 == 0 ? 1 : 3;
      FaultPlan plan = random_plan(seed, window, highest_rate);
      if (talk) plan.options.callbacks.on_event = print_event;
      const FaultVerdict verdict = try_plan(shorts[seed / 2 % shorts.size()], plan);
      const auto& options = plan.options;
      tallies[fmt::format("{} line{}{}{}", window, window == 1 ? "" : "s",
                          options.job.engine.noisy_ratio >= 1 ? " kept" : "",
                          options.emulator.features.meatpack ? " packed" : "")]
          .add(verdict);
      if (!verdict.violation.empty() || explain) {
        fmt::print("seed {}: {}\n  {} errors, {} strays, {} of them moves, {} noticed; {}{}{}\n", seed,
                   plan.description, verdict.errors, verdict.stray_commands, verdict.stray_moves,
                   verdict.strays_reported,
                   verdict.violation.empty() ? "fine" : "VIOLATED: " + verdict.violation,
                   verdict.failure.empty() ? "" : "; ", verdict.failure);
      }
    }
    fmt::print("\n{:<19} {:>7} {:>9} {:>9} {:>7} {:>8} {:>8} {:>7} {:>9} {:>9} {:>7} {:>6}\n", "window",
               "prints", "completed", "exact", "ended", "errors", "strays", "moves", "per 10000", "reported",
               "longest", "broken");
    std::int64_t bytes = 0;
    std::int64_t violations = 0;
    for (const auto& [name, tally] : tallies) {
      print_tally(name, tally);
      bytes += tally.bytes;
      violations += tally.violations;
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    fmt::print("\n{} prints of up to {} lines in {:.0f} s; {:.1f} MB sent\n", prints, length, took.count(),
               static_cast<double>(bytes) * 1e-6);
    return violations == 0 ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
}
