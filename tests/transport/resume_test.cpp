#include <cmath>
#include <map>
#include <random>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/transport/sample_print.h"
#include "tests/transport/session_rig.h"

// A print that one host began and another ends, in simulated time.

namespace {

using namespace lamina::transport;
using namespace std::chrono_literals;
using lamina::tests::sample_print;
using lamina::tests::SessionRig;
using lamina::tests::source_of;

PrintJobOptions options_for(std::size_t window) {
  PrintJobOptions options;
  options.engine.window.lines = window;
  options.source = "sample.gcode";
  return options;
}

std::vector<Bead> undisturbed(const std::vector<std::string>& lines) {
  SessionRig rig;
  PrintJob job(source_of(lines), options_for(3));
  rig.run(job);
  REQUIRE(job.progress().phase == JobPhase::kCompleted);
  return rig.printer().beads();
}

/// What the next host finds: the record as it was written down, in front of the bytes that it names.
JournalRecord found_by_next(const PrintJob& job) {
  return decode(encode(job.journal()));
}

/// By how much the height changes among the lines that may not have been run.
double heights_open(const JournalRecord& record) {
  MachineState state = record.printer;
  double low = *state.position[2];
  double high = low;
  for (const JournalLine& line : record.lines) {
    state = after(std::move(state), line.command);
    low = std::min(low, *state.position[2]);
    high = std::max(high, *state.position[2]);
  }
  return high - low;
}

}  // namespace

TEST_CASE("resume: a host lost behind any line, with any part of its last bytes delivered, changes nothing") {
  const auto lines = sample_print(70);
  const std::vector<Bead> clean = undisturbed(lines);
  const auto window = GENERATE(std::size_t{1}, std::size_t{3});
  const bool auto_report = GENERATE(true, false);
  EmulatorOptions printer = SessionRig::recording();
  printer.features.auto_report = auto_report;
  printer.features.arcs = auto_report;
  std::mt19937 random(window == 1 ? 21 : 22);
  std::int64_t lost_tails = 0;
  for (std::int64_t last = 1; last <= 95; ++last) {
    SessionRig rig(printer);
    JournalRecord record;
    {
      PrintJob first(source_of(lines), options_for(window));
      if (rig.run(first, [&] { return first.progress().wire.lines_sent >= last; })) break;
      record = found_by_next(first);
      lost_tails += rig.on_wire() > 0 ? 1 : 0;
      rig.lose_host(rig.on_wire() == 0 ? 0 : random() % (rig.on_wire() + 1));
    }
    rig.wait(std::chrono::milliseconds(random() % 20000));
    PrintJobOptions options = options_for(window);
    options.resume = record;
    PrintJob second(source_of(lines), options);
    rig.run(second);
    INFO("after line " << last << ": " << second.failure());
    REQUIRE(second.progress().phase == JobPhase::kCompleted);
    REQUIRE(rig.printer().beads() == clean);
  }
  CHECK(lost_tails > 20);
}

TEST_CASE("resume: again and again, by one host after the other") {
  const auto lines = sample_print(120);
  const std::vector<Bead> clean = undisturbed(lines);
  std::mt19937 random(23);
  SessionRig rig;
  std::optional<JournalRecord> record;
  for (int host = 0;; ++host) {
    REQUIRE(host < 100);
    PrintJobOptions options = options_for(3);
    options.resume = record;
    PrintJob job(source_of(lines), options);
    const auto life = static_cast<std::int64_t>(random() % 12 + 1);
    if (rig.run(job, [&] { return job.progress().wire.lines_sent >= life; })) {
      INFO(job.failure());
      REQUIRE(job.progress().phase == JobPhase::kCompleted);
      CHECK(host > 10);
      break;
    }
    record = found_by_next(job);
    rig.lose_host(random() % 40);
  }
  CHECK(rig.printer().beads() == clean);
}

TEST_CASE(
    "resume: lines that went out after the last record that reached the disk are found by their number") {
  const auto lines = sample_print(120);
  const std::vector<Bead> clean = undisturbed(lines);
  SessionRig rig;
  JournalRecord record;
  {
    PrintJob first(source_of(lines), options_for(3));
    rig.run(first, [&] { return first.progress().wire.lines_sent >= 40; });
    record = found_by_next(first);
    rig.go_on(first, [&] { return first.progress().wire.lines_sent >= 60; });
    rig.lose_host(0);
  }
  PrintJobOptions options = options_for(3);
  options.resume = record;
  PrintJob second(source_of(lines), options);
  rig.run(second);
  INFO(second.failure());
  REQUIRE(second.progress().phase == JobPhase::kCompleted);
  CHECK(rig.printer().beads() == clean);
}

TEST_CASE("resume: another file, and a printer that was moved, are refused without a line sent") {
  const auto lines = sample_print(60);
  SessionRig rig;
  PrintJobOptions options = options_for(3);
  {
    PrintJob first(source_of(lines), options_for(3));
    rig.run(first, [&] { return first.progress().wire.lines_sent >= 50; });
    options.resume = found_by_next(first);
    rig.lose_host(0);
  }
  rig.printer().receive("\n", rig.now());  // ends a line whose own end was lost
  rig.wait(60s);
  const auto beads = rig.printer().beads();
  SECTION("another file") {
    auto other = lines;
    other[3] += " ; changed";
    PrintJob second(source_of(other), options);
    rig.run(second);
    CHECK(second.failure_kind() == JobFailure::kSourceChanged);
  }
  SECTION("moved by its knob") {
    rig.printer().receive("G1 X5 Y5\n", rig.now());
    rig.wait(5s);
    PrintJob second(source_of(lines), options);
    rig.run(second);
    CHECK(second.failure_kind() == JobFailure::kNotResumable);
    CHECK(second.failure().find("stands at X5.00") != std::string::npos);
  }
  SECTION("restarted") {
    rig.printer().restart(rig.now());
    PrintJob second(source_of(lines), options);
    rig.run(second);
    CHECK(second.failure_kind() == JobFailure::kNotResumable);
    CHECK(second.failure().find("--after-restart") != std::string::npos);
    CHECK(rig.printer().machine().position(rig.now()).starts_with("X:0.00 Y:0.00"));
  }
  CHECK(rig.printer().beads() == beads);
}

TEST_CASE("resume after a restart: nothing is missing, at most the planner's moves are printed again") {
  const auto lines = sample_print(150);
  const std::vector<Bead> clean = undisturbed(lines);
  PrintJobOptions resumed = options_for(3);
  resumed.resume_after_restart = true;
  std::int64_t doubled_in_all = 0;
  int certain = 0;
  int in_doubt = 0;
  for (const std::int64_t last : {42, 53, 70, 95, 130, 160}) {
    INFO("after line " << last);
    SessionRig rig;
    {
      PrintJob first(source_of(lines), options_for(3));
      rig.run(first, [&] { return first.progress().wire.lines_sent >= last; });
      resumed.resume = found_by_next(first);
    }
    const std::size_t before = rig.printer().beads().size();
    rig.printer().restart(rig.now());
    PrintJob second(source_of(lines), resumed);
    rig.run(second);
    INFO(second.failure());
    REQUIRE(second.progress().phase == JobPhase::kCompleted);
    CHECK(rig.sent().find("G28Z") == std::string::npos);
    const std::vector<Bead>& beads = rig.printer().beads();
    // In front the undisturbed print; then the prime, away from the part; then the undisturbed print from
    // some bead on that is not behind the break, to its end.
    REQUIRE(beads.size() > before + 1);
    for (std::size_t i = 0; i < before; ++i) REQUIRE(beads[i] == clean[i]);
    const Bead& prime = beads[before];
    CHECK(prime.filament == Approx(ParkOptions{}.prime_cold));
    CHECK(prime.from == prime.to);
    const std::size_t again = beads.size() - before - 1;
    REQUIRE(again <= clean.size());
    const std::size_t begin = clean.size() - again;
    CHECK(begin <= before);
    CHECK(before - begin <= kMovesInPlanner);
    doubled_in_all += static_cast<std::int64_t>(before - begin);
    // Where a change of height was among the moves that may have been lost, nobody knows whether it was made:
    // the part goes on at the right height or above it, never below.
    const double range = heights_open(*resumed.resume);
    const double above = beads[before + 1].to[2] - clean[begin].to[2];
    CHECK(above >= -1e-6);
    CHECK(above <= range + 1e-6);
    (range > 0 ? in_doubt : certain) += 1;
    for (std::size_t i = 0; i < again; ++i) {
      const Bead& bead = beads[before + 1 + i];
      INFO("bead " << i << " of " << again);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double shift = axis == 2 ? above : 0;
        CHECK(bead.to[axis] - shift == Approx(clean[begin + i].to[axis]).margin(1e-6));
        if (i > 0) CHECK(bead.from[axis] - shift == Approx(clean[begin + i].from[axis]).margin(1e-6));
      }
      CHECK(bead.filament == Approx(clean[begin + i].filament).margin(1e-6));
    }
    CHECK(rig.printer().report().cold_extrusions == 0);
    CHECK(rig.printer().report().outside_moves == 0);
  }
  CHECK(doubled_in_all > 0);
  CHECK(certain > 1);
  CHECK(in_doubt > 1);
}

TEST_CASE("resume after a restart in the middle of the way back, and of a pause") {
  const auto lines = sample_print(100);
  const std::vector<Bead> clean = undisturbed(lines);
  PrintJobOptions resumed = options_for(3);
  resumed.resume_after_restart = true;
  SessionRig rig;
  {
    PrintJob first(source_of(lines), options_for(3));
    rig.run(first, [&] { return first.progress().wire.lines_sent >= 60; });
    first.pause(rig.now());
    rig.go_on(first, [&] { return first.progress().phase == JobPhase::kPaused; });
    resumed.resume = found_by_next(first);
  }
  // Lossless out of the pause, the host lost on the way back at one line after the other.
  for (int host = 0; host < 5; ++host) {
    PrintJob next(source_of(lines), resumed);
    rig.run(next, [&] { return next.progress().wire.lines_sent >= 3 + host; });
    resumed.resume = found_by_next(next);
    rig.lose_host(20);
    REQUIRE(resumed.resume->parked_from);
  }
  PrintJob last(source_of(lines), resumed);
  rig.run(last);
  INFO(last.failure());
  REQUIRE(last.progress().phase == JobPhase::kCompleted);
  // The primes apart, which fall at the parking place, it is the undisturbed print.
  std::vector<Bead> printed;
  for (const Bead& bead : rig.printer().beads()) {
    if (bead.from != bead.to) printed.push_back(bead);
  }
  REQUIRE(printed.size() == clean.size());
  for (std::size_t i = 0; i < clean.size(); ++i) {
    CHECK(printed[i].filament == Approx(clean[i].filament).margin(1e-6));
    CHECK(printed[i].to == clean[i].to);
  }
}

TEST_CASE("resume: heaters and fan that went off in the meantime are on again before the print goes on") {
  const auto lines = sample_print(100);
  const std::vector<Bead> clean = undisturbed(lines);
  SessionRig rig;
  PrintJobOptions options = options_for(3);
  {
    PrintJob first(source_of(lines), options_for(3));
    rig.run(first, [&] { return first.progress().wire.lines_sent >= 60; });
    options.resume = found_by_next(first);
    rig.lose_host(0);
  }
  rig.printer().receive("\nM104 S0\nM140 S0\nM107\n", rig.now());
  rig.wait(std::chrono::minutes(30));
  PrintJob second(source_of(lines), options);
  rig.run(second);
  INFO(second.failure());
  REQUIRE(second.progress().phase == JobPhase::kCompleted);
  CHECK(rig.printer().report().cold_extrusions == 0);
  CHECK(rig.sent().find("M106P0S255") != std::string::npos);
  REQUIRE(rig.printer().beads().size() == clean.size());
  for (std::size_t i = 0; i < clean.size(); ++i) {
    CHECK(rig.printer().beads()[i].to == clean[i].to);
    CHECK(rig.printer().beads()[i].filament == Approx(clean[i].filament).margin(1e-6));
  }
}
