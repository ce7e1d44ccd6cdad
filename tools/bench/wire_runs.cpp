#include "tools/bench/wire_runs.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace lamina::tools {

namespace {

using namespace transport;

constexpr double kRadius = 40;   // mm
constexpr double kChord = 0.2;   // mm
constexpr double kCentre = 100;  // mm

/// Bits on the wire of a byte: start, eight, stop.
constexpr double kBitsOfByte = 10;

WireUse measure(const std::vector<std::string>& lines, const WireCase& wire, const EmulatorOptions& printer) {
  EmulatedPrintOptions options;
  options.emulator = printer;
  options.to_printer.baud = options.to_host.baud = options.job.engine.baud = wire.baud;
  options.to_host.latency = wire.latency;
  options.to_host.packet = wire.latency > Duration{} ? 62 : 0;
  if (!wire.window) options.job.engine.window.lines = 1;
  // As in a print that has gone well for a while.
  options.job.engine.meatpack_after = 0;
  // Nothing beside the lines themselves.
  options.job.temperature_interval = Duration{};
  options.time_limit = std::chrono::hours(10);

  Instant now{};
  std::optional<Instant> first;
  Instant last{};
  std::int64_t bytes_before = 0;
  std::int64_t bytes_after = 0;
  std::int64_t moves = 0;
  std::vector<Event> pending;
  options.callbacks.on_event = [&](const Event& event) {
    const auto* sent = std::get_if<LineSent>(&event);
    const auto* acknowledged = std::get_if<LineAcknowledged>(&event);
    const NumberedLine* line = sent ? &sent->line : acknowledged ? &acknowledged->line : nullptr;
    if (line && line->command.starts_with("G1 X") && line->command.find(" E") != std::string::npos)
      pending.push_back(event);
  };
  options.steer = [&](PrintJob& job, Instant at) {
    now = at;
    for (const Event& event : pending) {
      if (std::holds_alternative<LineAcknowledged>(event)) {
        last = now;
        ++moves;
        bytes_after = job.progress().wire.bytes_sent;
      } else if (!first) {
        first = now;
        bytes_before = job.progress().wire.bytes_sent;
      }
    }
    pending.clear();
  };
  const EmulatedPrint print = print_on_emulator(
      [&lines, next = std::size_t{0}]() mutable -> std::optional<std::string> {
        if (next == lines.size()) return std::nullopt;
        return lines[next++];
      },
      options);
  if (print.result.outcome != JobPhase::kCompleted) throw std::runtime_error(print.result.failure);

  WireUse use;
  use.lines_per_second = static_cast<double>(moves) / to_seconds(last - *first);
  const double bytes_of_line = static_cast<double>(bytes_after - bytes_before) / static_cast<double>(moves);
  use.limit = wire.baud / kBitsOfByte / bytes_of_line;
  use.bytes_lost = print.report.bytes_lost;
  use.underruns = print.report.underruns;
  use.told_starved = to_seconds(print.result.progress.starved.total());
  use.moving = to_seconds(print.report.moving);
  return use;
}

EmulatorOptions usual_printer(const WireCase& wire) {
  EmulatorOptions printer;
  printer.thermal.room = 200;  // hot from the start
  printer.serial.overflow = Overflow::kLose;
  printer.features.advanced_ok = wire.advanced_ok;
  printer.features.meatpack = wire.meatpack;
  return printer;
}

}  // namespace

std::vector<std::string> circle_of_chords(int count, double speed) {
  std::vector<std::string> lines{
      "G21", "G90", "M83", "G28", "G1 Z0.2 F600", fmt::format("G1 X{} Y{} F6000", kCentre + kRadius, kCentre),
      "M400"};
  for (int i = 1; i <= count; ++i) {
    const double angle = i * kChord / kRadius;
    lines.push_back(fmt::format("G1 X{:.3f} Y{:.3f} E{:.5f}", kCentre + kRadius * std::cos(angle),
                                kCentre + kRadius * std::sin(angle), 0.00665));
    if (i == 1) lines.back() += fmt::format(" F{:.0f}", speed * 60);
  }
  return lines;
}

EmulatorOptions tireless_printer(const WireCase& wire) {
  EmulatorOptions printer = usual_printer(wire);
  printer.motion.max_feedrate = {1e4, 1e4, 1e4, 1e4};
  printer.motion.max_acceleration = {1e7, 1e7, 1e7, 1e7};
  printer.motion.acceleration = printer.motion.travel_acceleration = 1e7;
  printer.motion.min_segment_time = Duration{};
  printer.motion.homing_feedrate = {1000, 1000, 1000};
  return printer;
}

WireUse measure_wire(const std::vector<std::string>& lines, const WireCase& wire) {
  return measure(lines, wire, tireless_printer(wire));
}

WireUse measure_motion(const std::vector<std::string>& lines, const WireCase& wire) {
  return measure(lines, wire, usual_printer(wire));
}

}  // namespace lamina::tools
