#include "tools/bench/fault_campaign.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "transport/emulator/fault_order.h"
#include "transport/protocol/line_stripper.h"

namespace lamina::tools {

namespace {

using namespace transport;

/// No print of a campaign may take longer: most of it is the heating up.
constexpr Duration kTimeLimit = std::chrono::hours(2);

/// Longer than any line.
constexpr std::size_t kSpacing = 96;

LineSource source_of(const std::vector<std::string>& lines) {
  return [&lines, next = std::size_t{0}]() mutable -> std::optional<std::string> {
    if (next == lines.size()) return std::nullopt;
    return lines[next++];
  };
}

EmulatedPrintOptions quick_printer() {
  EmulatedPrintOptions options;
  options.emulator.record = RecordDetail::kBeads;
  options.emulator.thermal.hotend = {35, 160, 8};
  options.emulator.thermal.bed = {14, 400, 4};
  options.emulator.thermal.residency = std::chrono::seconds(2);
  options.emulator.motion.bed_max = {300, 300, 300};
  options.time_limit = kTimeLimit;
  return options;
}

/// The dice of one plan.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}

  std::size_t below(std::size_t count) { return random_() % count; }
  bool chance(double probability) { return uniform() < probability; }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  /// Evenly over the orders of magnitude.
  double rate(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  std::uint64_t seed() { return random_(); }

 private:
  double uniform() { return std::generate_canonical<double, 53>(random_); }

  std::mt19937_64 random_;
};

void choose_link(Dice& dice, EmulatedPrintOptions& options) {
  const int baud = dice.chance(0.5) ? 115200 : 250000;
  options.to_printer.baud = options.to_host.baud = options.job.engine.baud = baud;
  constexpr std::array kLatencies{0, 0, 1, 16};
  options.to_host.latency = std::chrono::milliseconds(kLatencies[dice.below(kLatencies.size())]);
  if (options.to_host.latency > Duration{}) options.to_host.packet = 62;
  EmulatorOptions& printer = options.emulator;
  printer.serial.overflow = Overflow::kLose;
  // Until an error line has gone out: none with a transmit buffer, 5.9 ms without one at 115200 baud.
  if (dice.chance(0.75)) printer.serial.refusal_time = from_seconds(dice.between(0, 0.0065));
  printer.features.advanced_ok = dice.chance(0.5);
  printer.features.emergency_parser = dice.chance(0.5);
  printer.features.host_actions = dice.chance(0.5);
  printer.features.silent_duplicates = dice.chance(0.9);
  printer.features.meatpack = dice.chance(0.3);
}

void choose_noise(Dice& dice, EmulatedPrintOptions& options, double highest_rate) {
  const bool packs = options.emulator.features.meatpack && options.job.engine.window.lines > 1;
  for (WireFaults* faults : {&options.to_printer.faults, &options.to_host.faults}) {
    const bool to_printer = faults == &options.to_printer.faults;
    const double rate = dice.chance(0.2) ? 0 : dice.rate(1e-5, highest_rate);
    const double share = rate / 4;
    faults->flip = share;
    faults->drop = share;
    faults->repeat = share;
    if (!packs || !to_printer) faults->insert = share;
    faults->spacing = kSpacing;
    faults->seed = dice.seed();
  }
  WireFaults& replies = options.to_host.faults;
  if (dice.chance(0.5)) replies.lose_ok = dice.rate(1e-4, highest_rate);
  if (dice.chance(0.5)) replies.double_ok = dice.rate(1e-4, highest_rate);
  if (dice.chance(0.5)) replies.double_resend = dice.between(0, 0.3);
}

FaultOrder order_at_command(FaultKind kind, Dice& dice, double amount, std::string text = {}) {
  return {kind, FaultClock::kCommand, static_cast<double>(5 + dice.below(250)), amount, std::move(text)};
}

/// One that a print survives.
FaultOrder choose_fault(Dice& dice) {
  constexpr std::array kMangled{"o", "k", "okok", "", "ok ok", "oook", "#k"};
  constexpr std::array kSaid{"//action:notification hello",
                             "echo:busy: processing",
                             "wait",
                             "Error:checksum mismatch",
                             "Error:something odd",
                             "\x80\xff\xfe noise",
                             "Resend:",
                             " T:20.0 /0.0 @:0",
                             "ok"};
  switch (dice.below(12)) {
    case 0:
      return order_at_command(FaultKind::kLoseOk, dice, 1);
    case 1:
      return order_at_command(FaultKind::kRepeatOk, dice, 1);
    case 2:
      return order_at_command(FaultKind::kMangleOk, dice, 1, kMangled[dice.below(kMangled.size())]);
    case 3:
      return order_at_command(FaultKind::kRefuseNumber, dice, static_cast<double>(1 + dice.below(3)));
    case 4:
      return order_at_command(FaultKind::kRefuseChecksum, dice, static_cast<double>(1 + dice.below(3)));
    case 5:
      return order_at_command(FaultKind::kRefuseMissing, dice, static_cast<double>(1 + dice.below(3)));
    case 6:
      return order_at_command(FaultKind::kRefuseSilently, dice, 1);
    case 7:
      return order_at_command(FaultKind::kResendStorm, dice, static_cast<double>(1 + dice.below(8)));
    case 8:
      return order_at_command(FaultKind::kStall, dice, dice.rate(0.01, 10));
    case 9:
      return order_at_command(FaultKind::kSilence, dice, dice.rate(0.01, 4));
    case 10:
      return order_at_command(FaultKind::kFullBuffer, dice, dice.rate(0.001, 1));
    default:
      return order_at_command(FaultKind::kSay, dice, 1, kSaid[dice.below(kSaid.size())]);
  }
}

FaultOrder choose_end(Dice& dice) {
  constexpr std::array kEnds{FaultKind::kRestart, FaultKind::kThermalRunaway, FaultKind::kUnplug,
                             FaultKind::kHeaterFails, FaultKind::kSilence};
  const FaultKind kind = kEnds[dice.below(kEnds.size())];
  // A silence of no length is one for good; a restart takes its time.
  return order_at_command(kind, dice, kind == FaultKind::kRestart && dice.chance(0.5) ? 1.5 : 0);
}

}  // namespace

std::vector<ShortPrint> short_prints(const std::vector<std::string>& gcode, std::size_t count,
                                     std::size_t length) {
  std::vector<std::size_t> layers;
  for (std::size_t i = 0; i < gcode.size(); ++i) {
    if (gcode[i].starts_with(";LAYER_CHANGE")) layers.push_back(i);
  }
  if (layers.empty())
    throw std::runtime_error("the G-code has no ;LAYER_CHANGE: it cannot be cut into prints");
  std::vector<ShortPrint> prints;
  for (std::size_t i = 0; i < count; ++i) {
    ShortPrint print;
    const std::size_t begin = layers[layers.size() * i / count];
    const std::size_t end = std::min(begin + length, gcode.size());
    print.lines.assign(gcode.begin(), gcode.begin() + static_cast<std::ptrdiff_t>(layers.front()));
    print.lines.insert(print.lines.end(), gcode.begin() + static_cast<std::ptrdiff_t>(begin),
                       gcode.begin() + static_cast<std::ptrdiff_t>(end));
    for (const char* last : {"M107", "M104 S0", "M140 S0", "M84"}) print.lines.emplace_back(last);
    print.commands = std::count_if(print.lines.begin(), print.lines.end(),
                                   [](const std::string& line) { return !strip_line(line).empty(); });
    EmulatedPrintOptions options = quick_printer();
    options.job.engine.window.lines = 1;
    EmulatedPrint clean = print_on_emulator(source_of(print.lines), options);
    if (clean.result.outcome != JobPhase::kCompleted)
      throw std::runtime_error(fmt::format("the print fails without any fault: {}", clean.result.failure));
    print.beads = std::move(clean.beads);
    prints.push_back(std::move(print));
    if (layers.size() * i / count == layers.size() * (i + 1) / count) ++i;
  }
  return prints;
}

namespace {

/// Where two prints part.
std::string difference(const std::vector<Bead>& printed, const std::vector<Bead>& expected) {
  const auto [at, wanted] = std::mismatch(printed.begin(), printed.end(), expected.begin(), expected.end());
  const auto text = [](const std::vector<Bead>& beads, std::vector<Bead>::const_iterator bead) {
    if (bead == beads.end()) return std::string("nothing");
    return fmt::format("({}, {}, {}) to ({}, {}, {}), {} mm of filament", bead->from[0], bead->from[1],
                       bead->from[2], bead->to[0], bead->to[1], bead->to[2], bead->filament);
  };
  return fmt::format("another part, and no stray moves: bead {} of {} is {} instead of {}",
                     at - printed.begin(), expected.size(), text(printed, at), text(expected, wanted));
}

}  // namespace

FaultPlan random_plan(std::uint64_t seed, std::size_t window, double highest_rate) {
  Dice dice(seed);
  FaultPlan plan;
  EmulatedPrintOptions& options = plan.options;
  options = quick_printer();
  options.job.engine.window.lines = window;
  if (window > 1 && dice.chance(0.5)) {
    // In the window as much as the rules allow, so that errors meet it.
    options.job.engine.cautious_lines = 3;
    options.job.engine.noisy_ratio = 1;
  }
  choose_link(dice, options);
  // Early, so that errors meet packed lines, or as it is usual.
  if (dice.chance(0.5)) options.job.engine.meatpack_after = 0;
  choose_noise(dice, options, highest_rate);
  EmulatorOptions& printer = options.emulator;
  for (std::size_t count = dice.below(4); count > 0; --count) printer.faults.push_back(choose_fault(dice));
  if (dice.chance(0.1)) printer.claims = {{"MEATPACK", true}, {"AUTOREPORT_TEMP", true}, {"ARCS", false}};
  if (dice.chance(0.1)) printer.power_up_noise = "\x7f\x80\xff\nxok\r\n\x01";
  if (dice.chance(0.1)) printer.serial.boot_time = from_seconds(dice.between(0.1, 2));
  plan.fatal = dice.chance(0.15);
  if (plan.fatal) printer.faults.push_back(choose_end(dice));
  printer.fault_seed = dice.seed();

  plan.description = fmt::format(
      "{} baud, latency {} ms, {} ok{}, refusal {} us, window {}{}, noise {:.1e} / {:.1e}, {} orders{}",
      options.to_printer.baud, options.to_host.latency / std::chrono::milliseconds(1),
      printer.features.advanced_ok ? "advanced" : "plain", printer.features.meatpack ? ", MeatPack" : "",
      printer.serial.refusal_time / std::chrono::microseconds(1), window,
      options.job.engine.noisy_ratio >= 1 ? " kept" : "", options.to_printer.faults.flip * 4,
      options.to_host.faults.flip * 4, printer.faults.size(), plan.fatal ? ", one fatal" : "");
  for (const FaultOrder& order : printer.faults) plan.description += ", " + text_of(order);
  return plan;
}

FaultVerdict try_plan(const ShortPrint& print, const FaultPlan& plan) {
  const EmulatedPrint printed = print_on_emulator(source_of(print.lines), plan.options);
  const PrintReport& report = printed.report;
  const EngineStatistics& wire = printed.result.progress.wire;
  FaultVerdict verdict;
  verdict.completed = printed.result.outcome == JobPhase::kCompleted;
  verdict.same_beads = printed.beads == print.beads;
  verdict.errors = report.refused_lines;
  verdict.stray_commands = report.unnumbered_commands;
  verdict.stray_moves = report.unnumbered_moves;
  verdict.strays_reported = wire.stray_replies;
  verdict.bytes = wire.bytes_sent;
  verdict.seconds = to_seconds(printed.result.elapsed);
  verdict.failure = printed.result.failure;

  const auto violated = [&verdict](std::string what) {
    if (verdict.violation.empty()) verdict.violation = std::move(what);
  };
  const bool restarted = plan.fatal;
  if (!restarted && report.doubled_lines > 0)
    violated(fmt::format("{} lines ran twice", report.doubled_lines));
  if (!restarted && report.skipped_lines > 0)
    violated(fmt::format("{} lines never ran", report.skipped_lines));
  if (!verdict.completed) {
    if (verdict.failure.find("hung") != std::string::npos) violated("hung: " + verdict.failure);
    if (verdict.failure.empty()) violated("ended without a reason");
    if (!plan.fatal) violated("ended although no fault was fatal: " + verdict.failure);
    return verdict;
  }
  if (printed.result.progress.job_lines_acknowledged != print.commands) {
    violated(fmt::format("{} of {} lines acknowledged", printed.result.progress.job_lines_acknowledged,
                         print.commands));
  }
  if (verdict.stray_commands == 0 && !verdict.same_beads) violated(difference(printed.beads, print.beads));
  if (plan.options.job.engine.window.lines == 1 && !verdict.same_beads)
    violated("another part, by stray moves");
  if (verdict.stray_commands > 0 && verdict.strays_reported == 0) violated("strays that nobody noticed");
  return verdict;
}

}  // namespace lamina::tools
