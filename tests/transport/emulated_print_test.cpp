#include <cstdint>
#include <numbers>
#include <numeric>
#include <string>

#include <catch2/catch.hpp>

#include "tests/transport/sample_print.h"
#include "transport/emulator/print_on_emulator.h"

// The print job and the emulated printer joined in simulated time, over good wires and bad ones.

namespace {

using namespace lamina::transport;
using namespace std::chrono_literals;
using lamina::tests::sample_print;
using lamina::tests::source_of;

EmulatedPrintOptions one_line_in_flight() {
  EmulatedPrintOptions options;
  options.job.engine.window.lines = 1;
  options.emulator.record = RecordDetail::kBeads;
  options.time_limit = 2h;
  return options;
}

EmulatedPrintOptions over_a_serial_line(EmulatedPrintOptions options, int baud) {
  options.to_printer.baud = baud;
  options.to_host.baud = baud;
  options.emulator.serial.overflow = Overflow::kLose;
  return options;
}

/// Every kind of harm to bytes that the firmware's checksum can see, both ways, at `rate` a byte; lost oks
/// and doubled resends.
void harm(EmulatedPrintOptions& options, double rate, std::uint64_t seed) {
  for (WireFaults* faults : {&options.to_printer.faults, &options.to_host.faults}) {
    faults->flip = faults->drop = faults->repeat = rate;
    faults->spacing = 120;
  }
  options.to_host.faults.insert = rate;
  options.to_host.faults.lose_ok = rate;
  options.to_host.faults.double_ok = rate;
  options.to_host.faults.double_resend = 0.2;
  options.to_printer.faults.seed = seed;
  options.to_host.faults.seed = seed + 1000;
}

/// Lines of the sample that reach the printer.
std::int64_t commands_in(const std::vector<std::string>& lines) {
  std::int64_t count = 0;
  for (const std::string& line : lines) count += line.starts_with(';') ? 0 : 1;
  return count;
}

}  // namespace

TEST_CASE("emulated print: a clean one completes, every line acknowledged, volume as written") {
  const int chords = 300;
  const auto lines = sample_print(chords);
  const auto window = GENERATE(std::size_t{1}, std::size_t{3});
  const bool advanced = GENERATE(false, true);
  const int baud = GENERATE(0, 115200);
  EmulatedPrintOptions options = over_a_serial_line(one_line_in_flight(), baud);
  options.job.engine.window.lines = window;
  options.emulator.features.advanced_ok = advanced;
  const EmulatedPrint print = print_on_emulator(source_of(lines), options);
  INFO(print.result.failure);
  REQUIRE(print.result.outcome == JobPhase::kCompleted);
  CHECK(print.result.progress.job_lines_sent == commands_in(lines));
  CHECK(print.result.progress.job_lines_acknowledged == commands_in(lines));
  CHECK(print.result.progress.wire.resends == 0);
  CHECK(print.result.progress.wire.probes == 0);
  CHECK(print.result.progress.wire.stray_replies == 0);
  CHECK(print.report.bytes_lost == 0);
  CHECK(print.report.refused_lines == 0);
  CHECK(print.report.cold_extrusions == 0);
  CHECK(print.report.outside_moves == 0);
  CHECK(print.report.unknown_commands == 0);
  CHECK(print.report.beads == chords);
  CHECK(print.report.layers == 5);

  double filament = 0;
  for (int i = 1; i <= chords; ++i) filament += 0.03 + 0.001 * (i % 7);
  CHECK(print.report.filament == Approx(filament).epsilon(1e-9));
  CHECK(print.report.volume == Approx(filament * std::numbers::pi * 1.75 * 1.75 / 4).epsilon(1e-9));
  CHECK(print.report.box_min[0] == Approx(40).margin(1e-3));
  CHECK(print.report.box_max[1] == Approx(60).margin(1e-3));
}

TEST_CASE("emulated print: the record does not depend on the link") {
  const auto lines = sample_print(200);
  const EmulatedPrint straight = print_on_emulator(source_of(lines), one_line_in_flight());
  for (const int baud : {115200, 250000}) {
    for (const Duration latency : {0ms, 1ms, 16ms}) {
      for (const std::size_t window : {1U, 3U}) {
        EmulatedPrintOptions options = over_a_serial_line(one_line_in_flight(), baud);
        options.to_host.latency = latency;
        options.job.engine.window.lines = window;
        const EmulatedPrint print = print_on_emulator(source_of(lines), options);
        CHECK(print.result.outcome == JobPhase::kCompleted);
        CHECK(print.report.bytes_lost == 0);
        CHECK(print.beads == straight.beads);
      }
    }
  }
}

TEST_CASE("emulated print: the same seed gives the same print") {
  const auto lines = sample_print(120);
  EmulatedPrintOptions options = over_a_serial_line(one_line_in_flight(), 115200);
  harm(options, 1e-3, 5);
  const EmulatedPrint first = print_on_emulator(source_of(lines), options);
  const EmulatedPrint second = print_on_emulator(source_of(lines), options);
  CHECK(first.result.elapsed == second.result.elapsed);
  CHECK(first.result.progress.wire.bytes_sent == second.result.progress.wire.bytes_sent);
  CHECK(first.beads == second.beads);
}

TEST_CASE("emulated print: with one line in flight a bad link changes nothing of what is deposited") {
  const auto lines = sample_print(200);
  const EmulatedPrint clean = print_on_emulator(source_of(lines), one_line_in_flight());
  REQUIRE(clean.result.outcome == JobPhase::kCompleted);
  const bool advanced = GENERATE(false, true);
  const double rate = GENERATE(3e-4, 1e-3, 3e-3);
  std::int64_t resends = 0;
  std::int64_t probes = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    EmulatedPrintOptions options = over_a_serial_line(one_line_in_flight(), 115200);
    options.emulator.features.advanced_ok = advanced;
    harm(options, rate, seed);
    const EmulatedPrint print = print_on_emulator(source_of(lines), options);
    INFO("seed " << seed << ", rate " << rate << ", advanced " << advanced << ": " << print.result.failure);
    REQUIRE(print.result.outcome == JobPhase::kCompleted);
    CHECK(print.result.progress.job_lines_acknowledged == commands_in(lines));
    CHECK(print.beads == clean.beads);
    resends += print.result.progress.wire.resends;
    probes += print.result.progress.wire.probes;
  }
  // The faults were there, and both ways of finding them out were needed.
  CHECK(resends > 20);
  CHECK(probes > 20);
}

TEST_CASE("emulated print: with a window a bad link never hangs the print nor loses a line") {
  const auto lines = sample_print(200);
  const EmulatedPrint clean = print_on_emulator(source_of(lines), one_line_in_flight());
  std::int64_t resends = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    EmulatedPrintOptions options = over_a_serial_line(one_line_in_flight(), 115200);
    options.job.engine.window.lines = 3;
    // Stay in the window as much as the rules allow, so that errors meet it.
    options.job.engine.cautious_lines = 5;
    options.job.engine.noisy_ratio = 1;
    harm(options, 1e-3, seed);
    const EmulatedPrint print = print_on_emulator(source_of(lines), options);
    INFO("seed " << seed << ": " << print.result.failure);
    REQUIRE(print.result.outcome == JobPhase::kCompleted);
    CHECK(print.result.progress.job_lines_acknowledged == commands_in(lines));
    // Strays apart, which the firmware makes up from cut lines, every bead is there, in order.
    std::size_t next = 0;
    for (const Bead& bead : print.beads) {
      if (next < clean.beads.size() && bead.filament == clean.beads[next].filament) ++next;
    }
    CHECK(next == clean.beads.size());
    resends += print.result.progress.wire.resends;
  }
  CHECK(resends > 60);
}

TEST_CASE("emulated print: lines that lose exactly their number change nothing of what is deposited") {
  const auto lines = sample_print(200);
  EmulatedPrintOptions options = over_a_serial_line(one_line_in_flight(), 115200);
  const EmulatedPrint clean = print_on_emulator(source_of(lines), options);
  // A receive buffer that loses everything for so long that what is left begins with the G, by chance.
  std::int64_t ran_without_number = 0;
  for (int round = 0; round < 80; ++round) {
    // (While the planner has room, so that the line comes right behind the ok.)
    FaultOrder deaf{
        FaultKind::kFullBuffer, FaultClock::kCommand, 22.0 + round % 8, 0.00045 + 0.000005 * round, {}};
    options.emulator.faults = {deaf};
    options.emulator.features.advanced_ok = round % 2 == 0;
    const EmulatedPrint print = print_on_emulator(source_of(lines), options);
    INFO("round " << round << ": " << print.result.failure);
    REQUIRE(print.result.outcome == JobPhase::kCompleted);
    CHECK(print.beads == clean.beads);
    CHECK(print.report.doubled_lines == 0);
    CHECK(print.report.skipped_lines == 0);
    ran_without_number += print.report.unnumbered_moves;
    CHECK((print.report.unnumbered_moves == 0 || print.result.progress.wire.stray_replies > 0));
  }
  CHECK(ran_without_number > 3);
}

TEST_CASE("emulated print: a question for temperatures that is open at the end does not hold it up") {
  const auto lines = sample_print(100);
  EmulatedPrintOptions options = over_a_serial_line(one_line_in_flight(), 115200);
  options.job.temperature_interval = 1ms;
  options.emulator.features.auto_report = false;
  options.emulator.faults = {parse_fault_order("silence=4@line:" + std::to_string(commands_in(lines)))};
  int steps = 0;
  options.cancelled = [&steps] { return ++steps > 1'000'000; };
  const EmulatedPrint print = print_on_emulator(source_of(lines), options);
  INFO(steps << " steps");
  CHECK(print.result.outcome == JobPhase::kCompleted);
}

TEST_CASE("emulated print: a printer that restarts or halts in the middle ends the print") {
  EmulatedPrintOptions options = one_line_in_flight();
  SECTION("restart") {
    options.emulator.faults = {parse_fault_order("restart@command:60")};
    const EmulatedPrint print = print_on_emulator(source_of(sample_print(200)), options);
    CHECK(print.result.outcome == JobPhase::kFailed);
    CHECK(print.result.failure.find("restarted in the middle") != std::string::npos);
    CHECK(print.result.progress.job_lines_acknowledged > 50);
    CHECK(print.result.progress.job_lines_acknowledged < 60);
  }
  SECTION("thermal fault") {
    options.emulator.faults = {parse_fault_order("thermal-runaway@command:60")};
    const EmulatedPrint print = print_on_emulator(source_of(sample_print(200)), options);
    CHECK(print.result.outcome == JobPhase::kFailed);
    CHECK(print.result.failure.find("Thermal Runaway") != std::string::npos);
  }
}

TEST_CASE("emulated print: a line that the printer cannot take ends the print before it") {
  const EmulatedPrint print = print_on_emulator(
      source_of({"G28", "G1 " + std::string(100, ' ') + "X1", "M220 " + std::string(100, 'S')}));
  CHECK(print.result.outcome == JobPhase::kFailed);
  CHECK(print.result.failure.find("line too long") != std::string::npos);
  CHECK(print.result.progress.job_lines_acknowledged <= 2);
}

TEST_CASE("emulated print: messages, line numbers and odd bytes of a file do no harm") {
  const EmulatedPrint print = print_on_emulator(
      source_of({"N5 G28*99", "M110 N100", "M117 " + std::string(200, 'x'), "M117 a\\b\bc", "M117 50*2"}));
  CHECK(print.result.outcome == JobPhase::kCompleted);
  CHECK(print.result.progress.wire.resends == 0);
  CHECK(print.result.progress.job_lines_acknowledged == 4);
}

TEST_CASE("emulated print: a dead link ends the print") {
  EmulatedPrintOptions options = one_line_in_flight();
  options.to_host.faults.drop = 1;
  const EmulatedPrint mute = print_on_emulator(source_of(sample_print(10)), options);
  CHECK(mute.result.outcome == JobPhase::kFailed);
  CHECK(mute.result.failure.find("no answer to the greeting") != std::string::npos);
  CHECK(mute.result.elapsed < 1min);
}

TEST_CASE("emulated print: a link that damages every line ends with a reason") {
  EmulatedPrintOptions options = one_line_in_flight();
  options.to_printer.faults.flip = 0.2;
  const EmulatedPrint print = print_on_emulator(source_of(sample_print(10)), options);
  CHECK(print.result.outcome == JobPhase::kFailed);
  CHECK_FALSE(print.result.failure.empty());
}

TEST_CASE("emulated print: cancelled while heating, it ends at once with the heaters off") {
  const bool emergency_parser = GENERATE(false, true);
  EmulatedPrintOptions options = one_line_in_flight();
  options.emulator.features.emergency_parser = emergency_parser;
  bool heating = false;
  int steps_since = 0;
  options.callbacks.on_event = [&](const Event& event) {
    if (const auto* reply = std::get_if<ReplyReceived>(&event)) {
      const auto* report = std::get_if<TemperatureReport>(&reply->reply);
      if (report != nullptr && report->waiting) heating = true;
    }
  };
  options.cancelled = [&] { return heating && ++steps_since > 50; };
  const EmulatedPrint print = print_on_emulator(source_of(sample_print(10)), options);
  CHECK(print.result.outcome == JobPhase::kCancelled);
  CHECK(print.report.beads == 0);
  CHECK(print.result.elapsed < 30s);
  CHECK(print_on_emulator(source_of(sample_print(0))).result.elapsed > 60s);
}

TEST_CASE("emulated print: ends in the middle when the printer is cancelled there") {
  EmulatedPrintOptions options = one_line_in_flight();
  std::int64_t acknowledged = 0;
  options.callbacks.on_event = [&](const Event& event) {
    if (std::holds_alternative<LineAcknowledged>(event)) ++acknowledged;
  };
  options.cancelled = [&] { return acknowledged > 100; };
  const EmulatedPrint print = print_on_emulator(source_of(sample_print(200)), options);
  CHECK(print.result.outcome == JobPhase::kCancelled);
  CHECK(print.report.beads > 50);
  CHECK(print.report.beads < 150);
}

TEST_CASE("emulated print: totals alone keep no beads") {
  EmulatedPrintOptions options = one_line_in_flight();
  options.emulator.record = RecordDetail::kTotals;
  const EmulatedPrint print = print_on_emulator(source_of(sample_print(100)), options);
  CHECK(print.report.beads == 100);
  CHECK(print.beads.empty());
}
