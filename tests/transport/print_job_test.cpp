#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/transport/sample_print.h"
#include "tests/transport/session_rig.h"

// What a print job does besides feeding lines: pauses, cancels, questions, faults.

namespace {

using namespace lamina::transport;
using namespace std::chrono_literals;
using lamina::tests::sample_print;
using lamina::tests::SessionRig;
using lamina::tests::source_of;

PrintJobOptions parking_at(double x, double y) {
  PrintJobOptions options;
  options.park.place = {{x, y}};
  return options;
}

std::vector<Bead> undisturbed(const std::vector<std::string>& lines) {
  SessionRig rig;
  PrintJob job(source_of(lines));
  rig.run(job);
  REQUIRE(job.progress().phase == JobPhase::kCompleted);
  return rig.printer().beads();
}

std::vector<Bead> moving(const std::vector<Bead>& beads) {
  std::vector<Bead> moving;
  for (const Bead& bead : beads) {
    if (bead.from != bead.to) moving.push_back(bead);
  }
  return moving;
}

void check_same(const std::vector<Bead>& a, const std::vector<Bead>& b) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].from == b[i].from);
    CHECK(a[i].to == b[i].to);
    CHECK(a[i].filament == Approx(b[i].filament).margin(1e-6));
  }
}

/// The job has sent so many lines of the print.
auto sent(const PrintJob& job, std::int64_t lines) {
  return [&job, lines] { return job.progress().job_lines_sent >= lines; };
}

auto in_phase(const PrintJob& job, JobPhase phase) {
  return [&job, phase] { return job.progress().phase == phase; };
}

}  // namespace

TEST_CASE("pause: parked, primed at the parking place, and printed on as if nothing had been") {
  const auto lines = sample_print(100);
  const std::vector<Bead> clean = undisturbed(lines);
  for (const std::int64_t at : {30, 73, 74, 75, 76, 77, 90}) {
    INFO("paused at line " << at);
    SessionRig rig;
    PrintJob job(source_of(lines), parking_at(5, 190));
    REQUIRE_FALSE(rig.run(job, sent(job, at)));
    job.pause(rig.now());
    REQUIRE_FALSE(rig.go_on(job, in_phase(job, JobPhase::kPaused)));
    const MachinePosition parked = rig.printer().machine().planned();
    CHECK(parked[0] == Approx(5));
    CHECK(parked[1] == Approx(190));
    CHECK(parked[2] >= 10);
    rig.wait(60s);
    job.resume(rig.now());
    rig.go_on(job);
    REQUIRE(job.progress().phase == JobPhase::kCompleted);
    check_same(moving(rig.printer().beads()), clean);
    double primed = 0;
    for (const Bead& bead : rig.printer().beads()) {
      if (bead.from != bead.to || bead.filament < 1e-9) continue;
      CHECK(bead.from[0] == Approx(5));
      primed += bead.filament;
    }
    CHECK(primed == Approx(ParkOptions{}.prime).margin(1e-6));
  }
}

TEST_CASE("pause: heaters stay on for their time, then cool, and are waited for on the way back") {
  const auto lines = sample_print(60);
  SessionRig rig;
  PrintJobOptions options = parking_at(5, 190);
  options.park.keep_nozzle_hot = 5min;
  options.park.keep_bed_hot = 20min;
  PrintJob job(source_of(lines), options);
  rig.run(job, sent(job, 30));
  job.pause(rig.now());
  rig.go_on(job, in_phase(job, JobPhase::kPaused));
  const Instant parked = rig.now();
  const auto nozzle_target = [&] { return const_cast<Machine&>(rig.printer().machine()).hotend().target(); };
  const auto bed_target = [&] { return const_cast<Machine&>(rig.printer().machine()).bed().target(); };
  rig.go_on(job, [&] { return rig.now() >= parked + 4min; });
  CHECK(nozzle_target() == 200);
  rig.go_on(job, [&] { return rig.now() >= parked + 6min; });
  CHECK(nozzle_target() == 0);
  CHECK(bed_target() == 60);
  rig.go_on(job, [&] { return rig.now() >= parked + 21min; });
  CHECK(bed_target() == 0);
  job.resume(rig.now());
  rig.go_on(job);
  CHECK(job.progress().phase == JobPhase::kCompleted);
  CHECK(rig.printer().report().cold_extrusions == 0);
  check_same(moving(rig.printer().beads()), undisturbed(lines));
}

TEST_CASE("console: commands go in order and numbered; what would spoil the print is refused") {
  const auto lines = sample_print(60);
  SessionRig rig;
  PrintJob job(source_of(lines));
  rig.run(job, sent(job, 30));
  CHECK(job.inject("G1 X0"));
  CHECK(job.inject("g92 e0"));
  CHECK(job.inject("T1"));
  CHECK_FALSE(job.inject("M220 S50"));
  CHECK_FALSE(job.inject("M221 S200"));
  CHECK_FALSE(job.inject("M117 hello"));
  rig.go_on(job);
  REQUIRE(job.progress().phase == JobPhase::kCompleted);
  const std::string& bytes = rig.sent();
  const std::size_t feed = bytes.find("M220S50*");
  REQUIRE(feed != std::string::npos);
  CHECK(bytes[bytes.rfind('\n', feed) + 1] == 'N');
  CHECK(feed < bytes.find("M221S200*"));
  CHECK(bytes.find("M221S200*") < bytes.find("M117 hello*"));
  // Twice the filament from there on.
  const auto clean = undisturbed(lines);
  CHECK(rig.printer().beads().back().filament == Approx(2 * clean.back().filament));
}

TEST_CASE("console: moves in a pause do not move the print") {
  const auto lines = sample_print(60);
  SessionRig rig;
  PrintJob job(source_of(lines), parking_at(5, 190));
  rig.run(job, sent(job, 40));
  job.pause(rig.now());
  rig.go_on(job, in_phase(job, JobPhase::kPaused));
  for (const char* command : {"G91", "G1 X10 Y-20 F3000", "M82", "G92 E7", "G1 E9"})
    CHECK_FALSE(job.inject(command));
  rig.wait(10s);
  job.resume(rig.now());
  rig.go_on(job);
  REQUIRE(job.progress().phase == JobPhase::kCompleted);
  check_same(moving(rig.printer().beads()), undisturbed(lines));
}

TEST_CASE("cancel: heaters off, up and away from the part, out of a pause, too") {
  const bool paused = GENERATE(false, true);
  SessionRig rig;
  PrintJob job(source_of(sample_print(100)), parking_at(5, 190));
  rig.run(job, sent(job, 60));
  if (paused) {
    job.pause(rig.now());
    rig.go_on(job, in_phase(job, JobPhase::kPaused));
  }
  const double height = rig.printer().machine().planned()[2];
  job.cancel(rig.now());
  rig.go_on(job);
  CHECK(job.progress().phase == JobPhase::kCancelled);
  CHECK(job.cancelled_by() == Instigator::kUser);
  const MachinePosition end = rig.printer().machine().planned();
  CHECK(end[0] == Approx(5));
  CHECK(end[2] == Approx(height + 10));
  CHECK(const_cast<Machine&>(rig.printer().machine()).hotend().target() == 0);
  CHECK(const_cast<Machine&>(rig.printer().machine()).bed().target() == 0);
}

TEST_CASE("cancel: a wait is broken off again and again until it ends") {
  EmulatorOptions printer = SessionRig::recording();
  printer.thermal.hotend = {0.001, 1e6, 8};  // never gets hot
  printer.features.emergency_parser = GENERATE(false, true);
  SessionRig rig(printer);
  PrintJob job(source_of({"M109 S200"}));
  rig.run(job, sent(job, 1));
  job.cancel(rig.now());
  rig.go_on(job);
  CHECK(job.progress().phase == JobPhase::kCancelled);
}

TEST_CASE("halt: M112 at once, unnumbered, and nothing behind it") {
  SessionRig rig;
  PrintJob job(source_of(sample_print(100)));
  rig.run(job, sent(job, 60));
  job.halt(rig.now());
  CHECK(job.take_discard());
  CHECK(job.take_output() == "\nM112\n");
  CHECK(job.progress().phase == JobPhase::kFailed);
  CHECK(job.failure().find("M112") != std::string::npos);
}

namespace {

/// A job that is printing, and whose printer is the test.
class Dialogue {
 public:
  explicit Dialogue(const std::vector<std::string>& lines, PrintJobOptions options = {},
                    const std::string& capabilities = "Cap:EMERGENCY_PARSER:1\n")
      : job(source_of(lines), quick(std::move(options))) {
    job.start(now);
    say("start\n");
    now += 3s;
    job.tick(now);
    say("ok\n");
    now += 1s;
    job.tick(now);
    say("FIRMWARE_NAME:Marlin 2.1 MACHINE_TYPE:Test EXTRUDER_COUNT:1\n" + capabilities + "ok\n");
  }

  /// The printer says this; what the host answers.
  std::string say(const std::string& text) {
    now += 1ms;
    job.receive(text, now);
    job.take_events();
    return job.take_output();
  }

  std::string pass(Duration span) {
    now += span;
    job.tick(now);
    job.take_events();
    return job.take_output();
  }

  Instant now{};
  PrintJob job;

 private:
  static PrintJobOptions quick(PrintJobOptions options) {
    options.temperature_interval = {};
    options.engine.window.lines = 1;
    return options;
  }
};

}  // namespace

TEST_CASE("host actions: pause, resume, cancel and disconnect") {
  Dialogue talk({"G28", "G1 X1 Y1 Z1 F600", "G1 X2", "G1 X3", "G1 X4", "G1 X5", "G1 X6"});
  REQUIRE(talk.job.progress().phase == JobPhase::kPrinting);
  talk.say("ok\n");
  talk.say("ok\n");
  SECTION("pause and resume") {
    talk.say("//action:pause\n");
    CHECK(talk.job.progress().phase == JobPhase::kPausing);
    CHECK(talk.job.progress().paused_by == Instigator::kPrinter);
    for (int i = 0; i < 20; ++i) talk.say("ok\n");
    CHECK(talk.job.progress().phase == JobPhase::kPaused);
    CHECK_FALSE(talk.say("//action:resume\n").empty());
    CHECK(talk.job.progress().phase == JobPhase::kReturning);
  }
  SECTION("paused by itself: it is only not fed") {
    talk.say("//action:paused\n");
    CHECK(talk.job.progress().phase == JobPhase::kPaused);
    talk.say("ok\n");  // a line that had its number already
    CHECK(talk.say("ok\n").empty());
    CHECK_FALSE(talk.say("//action:resumed\n").empty());
    CHECK(talk.job.progress().phase == JobPhase::kPrinting);
  }
  SECTION("cancel") {
    talk.say("//action:cancel\n");
    for (int i = 0; i < 30; ++i) talk.say("ok\n");
    CHECK(talk.job.progress().phase == JobPhase::kCancelled);
    CHECK(talk.job.cancelled_by() == Instigator::kPrinter);
  }
  SECTION("disconnect") {
    CHECK(talk.say("//action:disconnect\n").empty());
    CHECK(talk.job.failure_kind() == JobFailure::kDisconnected);
  }
}

TEST_CASE(
    "host actions: a prompt is collected, answered by its button, and M108 where nothing else is heard") {
  const bool emergency_parser = GENERATE(true, false);
  Dialogue talk({"G28", "M600", "G1 X2"}, {}, emergency_parser ? "Cap:EMERGENCY_PARSER:1\n" : "");
  talk.say("ok\n");
  talk.say("//action:prompt_end\n//action:prompt_begin Paused\n//action:prompt_button PurgeMore\n");
  CHECK_FALSE(talk.job.progress().prompt.shown);
  talk.say("//action:prompt_button Continue\n//action:prompt_show\necho:busy: paused for user\n");
  const HostPrompt& prompt = talk.job.progress().prompt;
  CHECK(prompt.shown);
  CHECK(prompt.text == "Paused");
  CHECK(prompt.buttons == std::vector<std::string>{"PurgeMore", "Continue"});
  CHECK(talk.job.progress().waits_for_user);
  talk.job.answer(1, talk.now);
  CHECK(talk.job.take_output() == (emergency_parser ? "\nM876 S1\n" : "\nM108\n"));
  CHECK_FALSE(talk.job.progress().prompt.shown);
}

TEST_CASE("faults: every one ends with what happened, where, and what to do") {
  Dialogue talk({"G28", "G1 X1 Y1 Z5.2 F600", ";LAYER:16", "G1 X2", "G1 X3"});
  for (int i = 0; i < 3; ++i) talk.say("ok\n");
  SECTION("restart") {
    talk.say("start\n");
    CHECK(talk.job.failure().find("restarted") != std::string::npos);
  }
  SECTION("thermal runaway") {
    talk.say("Error:Thermal Runaway, system stopped! Heater_ID: E0\n");
    CHECK(talk.job.failure().find("Thermal Runaway") != std::string::npos);
  }
  SECTION("cold extrusion") {
    talk.say("echo: cold extrusion prevented\n");
    for (int i = 0; i < 30; ++i) talk.say("ok\n");
    CHECK(talk.job.failure_kind() == JobFailure::kColdExtrusion);
  }
  CHECK(talk.job.progress().phase == JobPhase::kFailed);
  CHECK(talk.job.failure().find("line 4 of the file, 5.20 mm high, layer 17") != std::string::npos);
}

TEST_CASE("faults: an unknown setting is left out from then on, an unknown move ends the print") {
  Dialogue talk({"M300 S4", "M301", "M300 S5", "G28", "G1 X1 Y1 Z1 F600", "G5 X2 Y2 I1 J1 P1 Q1", "G1 X3"},
                {}, "Cap:ARCS:1\nCap:BEZIER:1\n");
  CHECK(talk.say("echo:Unknown command: \"M300S4\"\nok\n").find("M301") != std::string::npos);
  CHECK(talk.say("ok\n").find("G28") != std::string::npos);
  talk.say("ok\n");
  CHECK(talk.say("ok\n").find("G5X2") != std::string::npos);
  talk.say("echo:Unknown command: \"G5X2Y2I1J1P1Q1\"\nok\n");
  for (int i = 0; i < 30; ++i) talk.say("ok\n");
  CHECK(talk.job.progress().phase == JobPhase::kFailed);
  CHECK(talk.job.failure().find("does not know G5") != std::string::npos);
}

TEST_CASE("check: a printer that does not fit is refused before the first line") {
  PrintJobOptions options;
  options.check = [](const PrinterFacts& facts) -> std::optional<std::string> {
    CHECK(facts.firmware.machine == "Test");
    return "wrong printer";
  };
  Dialogue talk({"G28"}, options);
  CHECK(talk.job.progress().phase == JobPhase::kFailed);
  CHECK(talk.job.failure_kind() == JobFailure::kMismatch);
  CHECK(talk.job.progress().job_lines_sent == 0);
}

TEST_CASE("a slow source: the nozzle is parked in time, and the print is the same") {
  const auto lines = sample_print(100);
  int asked = 0;
  std::size_t given = 0;
  PrintJobOptions options = parking_at(5, 190);
  SessionRig rig;
  std::optional<Instant> behind_until;
  bool was_behind = false;
  options.source_level = [&] {
    ++asked;
    if (given >= 60 && !was_behind) {
      was_behind = true;
      behind_until = rig.now() + 40s;
    }
    return behind_until && rig.now() < *behind_until ? SourceLevel::kEmpty : SourceLevel::kPlenty;
  };
  LineSource source = [&]() -> std::optional<std::string> {
    if (given == lines.size()) return std::nullopt;
    return lines[given++];
  };
  PrintJob job(source, options);
  REQUIRE_FALSE(rig.run(job, in_phase(job, JobPhase::kPaused)));
  CHECK(job.progress().paused_by == Instigator::kSource);
  CHECK(rig.printer().machine().planned()[0] == Approx(5));
  // The nozzle did not wait on the part: the parking came before the last moves had ended.
  CHECK(rig.printer().report().underruns == 0);
  rig.go_on(job);
  REQUIRE(job.progress().phase == JobPhase::kCompleted);
  CHECK(job.progress().parked_for_source == 1);
  check_same(moving(rig.printer().beads()), undisturbed(lines));
  CHECK(asked > 100);
}

TEST_CASE("skipping an object leaves out its beads and no others") {
  std::vector<std::string> lines{"G90", "M83", "M104 S200", "G28", "M109 S200", "G1 X10 Y10 Z.2 F3000"};
  for (int layer = 1; layer <= 3; ++layer) {
    lines.push_back(fmt::format("G1 Z{:.1f}", 0.2 * layer));
    for (const char* object : {"a", "b", "c"}) {
      const double x = 20.0 * (object[0] - 'a' + 1);
      lines.push_back(fmt::format("; printing object {}", object));
      lines.push_back(fmt::format("G1 X{} Y20 F6000", x));
      lines.emplace_back("G1 E.8 F2100");
      for (int i = 1; i <= 4; ++i) lines.push_back(fmt::format("G1 X{} Y{} E.5 F1500", x + i, 20 + i));
      lines.emplace_back("G1 E-.8 F2100");
      lines.push_back(fmt::format("; stop printing object {}", object));
    }
  }
  lines.emplace_back("M84");
  const std::vector<Bead> clean = moving(undisturbed(lines));
  SessionRig rig;
  PrintJob job(source_of(lines));
  // Skipped while the first layer of c is printed.
  rig.run(job, [&] { return job.object() == std::optional<std::string>("c"); });
  job.skip_object("b");
  rig.go_on(job);
  REQUIRE(job.progress().phase == JobPhase::kCompleted);
  std::vector<Bead> expected;
  for (const Bead& bead : clean) {
    const bool of_b = bead.to[0] > 39 && bead.to[0] < 50;
    if (!of_b || bead.to[2] < 0.3) expected.push_back(bead);
  }
  REQUIRE(expected.size() == clean.size() - 8);
  check_same(moving(rig.printer().beads()), expected);
}
