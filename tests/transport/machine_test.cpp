#include <cmath>
#include <numbers>
#include <string>

#include <catch2/catch.hpp>

#include "tests/transport/emulator_talk.h"
#include "transport/emulator/curve_segments.h"
#include "transport/emulator/emulator.h"
#include "transport/emulator/heater.h"
#include "transport/emulator/planner.h"
#include "transport/emulator/trapezoid.h"

// The emulated machine against closed forms.

namespace {

using namespace lamina::transport;
using lamina::tests::hot_printer;
using namespace std::chrono_literals;

/// No waiting before the first block, and a true standstill at both ends.
MotionOptions plain_motion() {
  MotionOptions motion;
  motion.first_block_delay = 0s;
  motion.minimum_speed = 0;
  motion.min_segment_time = 0s;
  motion.max_acceleration = {1000, 1000, 1000, 1000};
  motion.max_feedrate = {200, 200, 200, 200};
  motion.acceleration = motion.travel_acceleration = motion.retract_acceleration = 1000;
  return motion;
}

PlannedMove move_to(MachinePosition from, MachinePosition to, double feedrate) {
  return {from, to, feedrate, 0};
}

/// Runs the planner dry; the time it took in seconds.
double run_dry(Planner& planner) {
  Instant now{};
  while (const auto next = planner.next_event()) {
    now = *next;
    planner.advance(now);
  }
  return to_seconds(now.time_since_epoch());
}

struct Run : lamina::tests::EmulatorTalk {
  explicit Run(const EmulatorOptions& options = hot_printer()) : EmulatorTalk(options) {}

  std::string say(const std::string& bytes, Duration listen = 600s) {
    return EmulatorTalk::say(bytes, listen);
  }
};

}  // namespace

TEST_CASE("trapezoid: a long and a short move take what the formulas say") {
  // 100 mm at 50 mm/s and 500 mm/s^2: d / v + v / a.
  CHECK(make_trapezoid(100, 0, 50, 0, 500).duration() == Approx(100.0 / 50 + 50.0 / 500));
  // 2 mm: the top is never reached: 2 * sqrt(d / a).
  const Trapezoid triangle = make_trapezoid(2, 0, 50, 0, 500);
  CHECK(triangle.duration() == Approx(2 * std::sqrt(2.0 / 500)));
  CHECK(triangle.cruise_speed == Approx(std::sqrt(2.0 * 500)));
  // From 30 to 10 mm/s.
  const Trapezoid move = make_trapezoid(20, 30, 50, 10, 500);
  const double up = (50 * 50 - 30 * 30) / 1000.0;
  const double down = (50 * 50 - 10 * 10) / 1000.0;
  CHECK(move.duration() == Approx(20.0 / 500 + 40.0 / 500 + (20 - up - down) / 50));
}

TEST_CASE("trapezoid: the way covered is the integral of the speed") {
  const auto [distance, entry, speed, exit] = GENERATE(table<double, double, double, double>(
      {{100, 0, 50, 0}, {2, 0, 50, 0}, {20, 30, 50, 10}, {5, 0, 10, 10}, {0.1, 5, 80, 3}}));
  const Trapezoid move = make_trapezoid(distance, entry, speed, exit, 500);
  CHECK(move.distance_at(0) == 0);
  CHECK(move.distance_at(move.duration()) == Approx(distance));
  const int steps = 1000;
  double before = 0;
  for (int i = 1; i <= steps; ++i) {
    const double at = move.distance_at(move.duration() * i / steps);
    CHECK(at >= before);
    CHECK((at - before) * steps / move.duration() <= speed * (1 + 1e-9));
    before = at;
  }
}

TEST_CASE("planner: one move takes the time of its trapezoid") {
  Planner planner(plain_motion());
  planner.push(move_to({}, {30, 40, 0, 0}, 100), Instant{});
  CHECK(run_dry(planner) == Approx(50.0 / 100 + 100.0 / 1000));
  CHECK(planner.position(Instant{}) == MachinePosition{30, 40, 0, 0});
}

TEST_CASE("planner: axes limit a move by their own speed and acceleration") {
  MotionOptions motion = plain_motion();
  motion.max_feedrate[2] = 5;
  motion.max_acceleration[2] = 100;
  Planner planner(motion);
  planner.push(move_to({}, {0, 0, 10, 0}, 100), Instant{});
  CHECK(run_dry(planner) == Approx(10.0 / 5 + 5.0 / 100));
  // Along x = z both meet: 5 mm/s in z are 5 * sqrt(2) along the way, and so with the acceleration.
  Planner slanted(motion);
  slanted.push(move_to({}, {10, 0, 10, 0}, 100), Instant{});
  CHECK(run_dry(slanted) == Approx(10.0 / 5 + 5.0 / 100));
}

TEST_CASE("planner: straight on is one move, a reversal is two") {
  Planner straight(plain_motion());
  for (int i = 0; i < 10; ++i)
    straight.push(move_to({i * 10.0, 0, 0, 0}, {(i + 1) * 10.0, 0, 0, 0}, 100), Instant{});
  CHECK(run_dry(straight) == Approx(100.0 / 100 + 100.0 / 1000));

  Planner reversed(plain_motion());
  reversed.push(move_to({0, 0, 0, 0}, {50, 0, 0, 0}, 100), Instant{});
  reversed.push(move_to({50, 0, 0, 0}, {0, 0, 0, 0}, 100), Instant{});
  CHECK(run_dry(reversed) == Approx(2 * (50.0 / 100 + 100.0 / 1000)));
}

TEST_CASE("planner: a right angle is taken at the speed of junction deviation") {
  const MotionOptions motion = plain_motion();
  Planner planner(motion);
  planner.push(move_to({0, 0, 0, 0}, {50, 0, 0, 0}, 100), Instant{});
  planner.push(move_to({50, 0, 0, 0}, {50, 50, 0, 0}, 100), Instant{});
  // v^2 = a * jd * sin(45 deg) / (1 - sin(45 deg)); along the bisector both axes share the acceleration.
  const double sine = std::sqrt(0.5);
  const double along_bisector = 1000 / sine;
  const double limited = std::min(1000.0, along_bisector);
  const double corner = std::sqrt(limited * motion.junction_deviation * sine / (1 - sine));
  const double half = 100.0 / 1000 + (100 - corner) / 1000 +
                      (50 - 100.0 * 100 / 2000 - (100.0 * 100 - corner * corner) / 2000) / 100;
  CHECK(run_dry(planner) == Approx(2 * half));
}

TEST_CASE("planner: short segments are stretched while the buffer runs low") {
  MotionOptions motion = plain_motion();
  motion.min_segment_time = 20ms;
  motion.max_acceleration = {1e9, 1e9, 1e9, 1e9};
  motion.acceleration = motion.travel_acceleration = 1e9;
  // 1 mm at 100 mm/s is 10 ms. Into 2 waiting ones: 10 + 2 * 10 / 2 = 20 ms.
  Planner planner(motion);
  for (int i = 0; i < 3; ++i) planner.push(move_to({i * 1.0, 0, 0, 0}, {i + 1.0, 0, 0, 0}, 100), Instant{});
  CHECK(run_dry(planner) == Approx(0.010 + 0.010 + 0.020).epsilon(0.01));
}

TEST_CASE("planner: 15 moves fit, and the first waits for company") {
  MotionOptions motion = plain_motion();
  motion.first_block_delay = 100ms;
  Planner planner(motion);
  CHECK(planner.free() == 15);
  planner.push(move_to({}, {1, 0, 0, 0}, 10), Instant{});
  CHECK(planner.free() == 14);
  CHECK(planner.next_event() == Instant{100ms});
  planner.push(move_to({1, 0, 0, 0}, {2, 0, 0, 0}, 10), Instant{10ms});
  CHECK(planner.next_event() == Instant{100ms});
  planner.push(move_to({2, 0, 0, 0}, {3, 0, 0, 0}, 10), Instant{20ms});
  CHECK(planner.next_event() == Instant{20ms});
}

TEST_CASE("heater: it rises with its time constant, arrives, and stays") {
  const HeaterOptions options{3.5, 160, 8};
  Heater heater(options, 20, Instant{});
  heater.set_target(500);
  CHECK(heater.power() == 127);
  heater.advance(Instant{60s});
  // Full power all the way: T = room + rate * tau * (1 - exp(-t / tau)).
  CHECK(heater.temperature() == Approx(20 + 3.5 * 160 * (1 - std::exp(-60.0 / 160))).epsilon(1e-6));

  Heater arriving(options, 20, Instant{});
  arriving.set_target(200);
  double highest = 0;
  for (int second = 1; second <= 600; ++second) {
    arriving.advance(Instant{std::chrono::seconds(second)});
    highest = std::max(highest, arriving.temperature());
  }
  CHECK(arriving.temperature() == Approx(200).margin(0.01));
  CHECK(highest < 201);

  // Off: it cools as an exponential.
  arriving.set_target(0);
  CHECK(arriving.power() == 0);
  arriving.advance(Instant{760s});
  CHECK(arriving.temperature() == Approx(20 + 180 * std::exp(-1.0)).epsilon(1e-4));
}

TEST_CASE("heater: how often one looks does not matter") {
  const HeaterOptions options{3.5, 160, 8};
  Heater once(options, 20, Instant{});
  Heater often(options, 20, Instant{});
  once.set_target(210);
  often.set_target(210);
  once.advance(Instant{123s});
  for (int i = 1; i <= 12300; ++i) often.advance(Instant{i * 10ms});
  CHECK(once.temperature() == often.temperature());
}

TEST_CASE("curves: chords lie on the arc, as many as the firmware makes") {
  // A quarter of radius 10, counter-clockwise: 15.7 mm, so 72 / 4 chords rather than one a millimetre.
  const MachinePosition start{10, 0, 0, 0};
  const MachinePosition end{0, 10, 1, 2};
  const auto quarter = arc_segments(start, end, *arc_by_center(start, -10.0, std::nullopt, false, 0));
  CHECK(quarter.size() == 18);
  CHECK(quarter.back() == end);
  for (std::size_t i = 0; i < quarter.size(); ++i) {
    const double angle = std::numbers::pi / 2 * static_cast<double>(i + 1) / 18;
    CHECK(quarter[i][0] == Approx(10 * std::cos(angle)).margin(1e-9));
    CHECK(quarter[i][1] == Approx(10 * std::sin(angle)).margin(1e-9));
    CHECK(quarter[i][2] == Approx((static_cast<double>(i) + 1) / 18));
    CHECK(quarter[i][3] == Approx(2 * (static_cast<double>(i) + 1) / 18));
  }
  // Radius 50 once round, 314.16 mm: no chord above 1 mm.
  CHECK(arc_segments({50, 0, 0, 0}, {50, 0, 0, 0}, {0, 0, true, 0}).size() == 315);
  // Radius 0.5: no chord below 0.1 mm.
  CHECK(arc_segments({0.5, 0, 0, 0}, {0.5, 0, 0, 0}, {0, 0, true, 0}).size() == 31);
  // Clockwise from the same place is the long way round.
  CHECK(arc_segments(start, end, *arc_by_center(start, -10.0, 0.0, true, 0)).size() == 54);
}

TEST_CASE("curves: R gives the shorter way, negative R the longer") {
  const MachinePosition start{10, 0, 0, 0};
  const MachinePosition end{0, 10, 0, 0};
  const auto shorter = arc_by_radius(start, end, 10, false);
  REQUIRE(shorter);
  CHECK(shorter->center_x == Approx(0).margin(1e-9));
  CHECK(shorter->center_y == Approx(0).margin(1e-9));
  const auto longer = arc_by_radius(start, end, -10, false);
  REQUIRE(longer);
  CHECK(longer->center_x == Approx(10));
  CHECK(longer->center_y == Approx(10));
  CHECK(arc_segments(start, end, *longer).size() == 54);
  CHECK_FALSE(arc_by_radius(start, start, 10, false));
  CHECK_FALSE(arc_by_center(start, std::nullopt, std::nullopt, false, 0));
}

TEST_CASE("emulator: the volume deposited is filament times its area, retractions deposit nothing") {
  Run run;
  run.say("G90\nM83\n");
  run.say("G1 X10 Y0 E1 F1200\nG1 E-0.8\nG1 X20\nG1 E0.8\nG1 X20 Y10 E2\nG1 E-0.8\nG1 E1.0\n");
  const PrintReport& report = run.printer.report();
  CHECK(report.filament == Approx(3.2));
  CHECK(report.filament_fed == Approx(3.2));
  CHECK(report.volume == Approx(3.2 * std::numbers::pi * 1.75 * 1.75 / 4));
  CHECK(report.beads == 2);
  CHECK(report.layers == 1);
  REQUIRE(run.printer.beads().size() == 3);
  CHECK(run.printer.beads()[1].from == std::array<double, 3>{20, 0, 0});
  CHECK(run.printer.beads()[1].to == std::array<double, 3>{20, 10, 0});
  CHECK(run.printer.beads()[1].filament == 2);
  CHECK(run.printer.beads()[2].filament == Approx(0.2));
}

TEST_CASE("emulator: coordinates absolute, relative, named anew, in inches") {
  Run run;
  run.say("G91\nG1 X10 Y10 F6000\nG1 X5\nG90\nG92 X0\nG1 X1\n");
  CHECK(run.say("M114\n").starts_with("X:1.00 Y:10.00 Z:0.00 E:0.00 Count X:1280"));
  run.say("G20\nG1 Y1\nG21\n");
  CHECK(run.say("M114\n").starts_with("X:1.00 Y:25.40 "));
  // M82: E is a place, M83: a way. G90 makes it a place again.
  run.say("M82\nG92 E10\nG1 X2 E11\nM83\nG1 X3 E1\nG90\nG1 X4 E12.5\n");
  CHECK(run.printer.report().filament == Approx(2.5));
}

TEST_CASE("emulator: what the firmware prevents is counted") {
  EmulatorOptions cold = hot_printer();
  cold.thermal.room = 20;
  Run run(cold);
  run.say("M83\n");
  CHECK(run.say("G1 X10 E1 F1200\n") == "echo: cold extrusion prevented\nok\n");
  CHECK(run.printer.report().cold_extrusions == 1);
  CHECK(run.printer.report().filament == 0);
  CHECK(run.say("M114\n").starts_with("X:10.00"));

  Run hot;
  CHECK(hot.say("G1 X10 E201 F6000\n") == "echo: too long extrusion prevented\nok\n");
  // Not homed: it goes where it is told. Homed: soft limits hold it.
  hot.say("G1 X-10\n");
  CHECK(hot.say("M114\n").starts_with("X:-10.00"));
  hot.say("G28\nG1 X-10 Y300\n");
  CHECK(hot.say("M114\n").starts_with("X:0.00 Y:200.00"));
  CHECK(hot.printer.report().outside_moves == 2);
}

TEST_CASE("emulator: flow and feed changes take effect") {
  Run run;
  run.say("M83\nM221 S50\nG1 X10 E1 F600\n");
  CHECK(run.printer.report().filament == Approx(0.5));
  CHECK(run.say("M221\nM220\n") == "echo:E0 Flow: 50%\nok\nFR:100%\nok\n");
  const auto time_of = [](const std::string& setting) {
    Run timed;
    timed.say(setting + "G1 X100 F600\nM400\n");
    return to_seconds(timed.printer.report().moving);
  };
  CHECK(time_of("M220 S200\n") == Approx(time_of("") / 2).epsilon(0.05));
}

TEST_CASE("emulator: temperatures rise in time, and M190 waits for the bed") {
  EmulatorOptions options;
  options.greet = false;
  Run run(options);
  const std::string heard = run.say("M190 S60\n", 1000s);
  CHECK(heard.ends_with("ok\n"));
  CHECK(run.printer.machine().temperatures().find("B:60.00 /60.00") != std::string::npos);
  // Cooling is not waited for with S, and is with R.
  CHECK(run.say("M190 S40\n", 0s) == "ok\n");
  CHECK(run.say("M190 R35\n", 1s).find("ok\n") == std::string::npos);
  CHECK(run.say("", 1000s).ends_with("ok\n"));
}

TEST_CASE("emulator: reports come by themselves when asked for") {
  EmulatorOptions options;
  options.greet = false;
  Run run(options);
  CHECK(run.say("M155 S2\n", 4500ms) ==
        "ok\n T:20.00 /0.00 B:20.00 /0.00 @:0 B@:0\n T:20.00 /0.00 B:20.00 /0.00 @:0 B@:0\n");
  CHECK(run.say("M155 S0\nM154 S1\n", 1500ms) == "ok\nok\nX:0.00 Y:0.00 Z:0.00 E:0.00 Count X:0 Y:0 Z:0\n");
}

TEST_CASE("emulator: a planner that runs dry while extruding is an underrun, a wished-for stop is not") {
  Run run;
  run.say("M83\nG1 X10 E1 F1200\n", 10s);
  run.say("G1 X20 E1\nM400\n", 10s);
  CHECK(run.printer.report().underruns == 1);
  CHECK(to_seconds(run.printer.report().starved) == Approx(10 - 0.1 - 0.5).margin(0.1));
  run.say("G1 X30 E1\nG4 S1\nG1 X40 E1\n", 10s);
  CHECK(run.printer.report().underruns == 1);
}

TEST_CASE("emulator: bytes that find the buffer full are lost, or held back") {
  EmulatorOptions options = hot_printer();
  const std::string wait = "G4 S60\n";
  const std::string line = "G1 X1\n";
  std::string flood;
  for (int i = 0; i < 100; ++i) flood += line;
  Run holding(options);
  holding.say(wait, 0s);
  const std::size_t taken = holding.printer.receive(flood, holding.now);
  // Three lines in the queue behind the one that runs, 127 bytes in the buffer.
  CHECK(taken == 3 * line.size() + 127);
  CHECK(holding.printer.report().bytes_lost == 0);

  options.serial.overflow = Overflow::kLose;
  Run losing(options);
  losing.say(wait, 0s);
  CHECK(losing.printer.receive(flood, losing.now) == flood.size());
  CHECK(losing.printer.report().bytes_lost == static_cast<std::int64_t>(flood.size()) - 127);
}

TEST_CASE("emulator: switched off and on it has forgotten") {
  Run run;
  run.say("N1 G91*19\nG1 X10 F6000\n");
  run.printer.restart(run.now);
  CHECK(run.printer.last_line() == 0);
  CHECK(run.say("M114\n").starts_with("X:0.00"));
  EmulatorOptions greeting;
  CHECK(Emulator(greeting).take_output().starts_with("start\nPowerUp\nMarlin 2.1.2.1\n"));
}
