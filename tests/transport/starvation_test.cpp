#include "transport/session/starvation.h"

#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/transport/sample_print.h"
#include "transport/emulator/print_on_emulator.h"

// What the host believes of the planner, against closed forms, and against the emulated planner's own count.

namespace {

using namespace lamina::transport;
using namespace std::chrono_literals;

/// The account of a host that hears of moves of 100 ms each.
class Account {
 public:
  Account() { hear("G1 X0 F6000"); }

  void hear(const std::string& command, bool at_once = true) {
    clock.acknowledged({{++number_, command, LineOrigin::kJob}, at_once}, now);
  }

  /// To X10, X0, X10 and so on: 10 mm at 100 mm/s.
  void move(bool at_once = true) {
    there_ = !there_;
    hear(there_ ? "G1 X10" : "G1 X0", at_once);
  }

  void pass(Duration time, Obstacle obstacle) {
    now += time;
    clock.advance(now, obstacle);
  }

  StarvationClock clock;
  Instant now{};

 private:
  LineNumber number_ = 0;
  bool there_ = false;
};

}  // namespace

TEST_CASE("starvation: a move that comes after the last one has ended was missed, by what was in the way") {
  Account account;
  account.move();
  account.pass(100ms, Obstacle::kWire);
  CHECK(account.clock.total().total() == Duration{});
  account.pass(30ms, Obstacle::kWire);
  account.pass(20ms, Obstacle::kRecovery);
  account.pass(10ms, Obstacle::kSource);
  CHECK(account.clock.total().total() == Duration{});
  account.move();
  CHECK(account.clock.total().by_wire == 30ms);
  CHECK(account.clock.total().by_recovery == 20ms);
  CHECK(account.clock.total().by_source == 10ms);
  // Ahead of time: none.
  account.pass(50ms, Obstacle::kWire);
  account.move();
  account.pass(149ms, Obstacle::kWire);
  account.move();
  CHECK(account.clock.total().total() == 60ms);
}

TEST_CASE("starvation: a planner that had no place for a line was not dry") {
  Account account;
  for (int i = 0; i < 10; ++i) account.move();
  // Slower than the feed rate says, as round corners; but this one had to wait.
  account.pass(5s, Obstacle::kWire);
  account.move(false);
  CHECK(account.clock.total().total() == Duration{});
  // It was full: eight moves of 100 ms at least, the first of which may be about to end.
  account.pass(700ms, Obstacle::kWire);
  account.move();
  CHECK(account.clock.total().total() == Duration{});
}

TEST_CASE("starvation: waiting for heaters, homing and pauses count for nothing") {
  Account account;
  account.move();
  account.pass(60s, Obstacle::kWire);
  account.hear("M109 S200", false);
  account.pass(10s, Obstacle::kSource);
  account.move();
  CHECK(account.clock.total().total() == Duration{});
  account.pass(60s, Obstacle::kNone);
  account.move();
  CHECK(account.clock.total().total() == Duration{});
}

namespace {

/// 0.2 mm chords at 60 mm/s, 300 lines a second wanted, over a link of 115200 baud.
EmulatedPrint print_chords(bool advanced, int latency, std::size_t window) {
  std::vector<std::string> lines{"G21", "G90", "M83", "G28", "G1 X140 Y100 Z0.2 F6000", "M400"};
  for (int i = 1; i <= 600; ++i) {
    const double angle = i * 0.2 / 40;
    lines.push_back(fmt::format("G1 X{:.3f} Y{:.3f} E0.00665{}", 100 + 40 * std::cos(angle),
                                100 + 40 * std::sin(angle), i == 1 ? " F3600" : ""));
  }
  EmulatedPrintOptions options;
  options.emulator.thermal.room = 200;
  options.emulator.features.advanced_ok = advanced;
  options.job.engine.window.lines = window;
  options.job.temperature_interval = {};
  options.to_printer.baud = options.to_host.baud = options.job.engine.baud = 115200;
  options.to_host.latency = std::chrono::milliseconds(latency);
  options.to_host.packet = latency > 0 ? 62 : 0;
  return print_on_emulator(lamina::tests::source_of(lines), options);
}

}  // namespace

TEST_CASE("starvation: the host's account is near what the emulated machine lost") {
  const double least = to_seconds(print_chords(false, 0, 3).report.moving);
  for (const bool advanced : {false, true}) {
    for (const int latency : {0, 1, 16}) {
      for (const std::size_t window : {std::size_t{1}, std::size_t{3}}) {
        const EmulatedPrint print = print_chords(advanced, latency, window);
        REQUIRE(print.result.outcome == JobPhase::kCompleted);
        const double told = to_seconds(print.result.progress.starved.total());
        const double lost = to_seconds(print.report.moving) - least;
        INFO((advanced ? "advanced" : "plain") << " ok, latency " << latency << " ms, window " << window
                                               << ": " << told << " s of " << lost << " s");
        // The emulated planner, too, stretches moves and then is full for a moment.
        CHECK(told >= 0.5 * lost - 0.05);
        CHECK(told <= 1.1 * lost + 0.05);
        CHECK(print.result.progress.starved.by_recovery == Duration{});
        CHECK(print.result.progress.starved.by_source == Duration{});
      }
    }
  }
}
