#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "tests/transport/emulator_talk.h"
#include "transport/emulator/emulator.h"
#include "transport/emulator/planner.h"
#include "transport/protocol/line_framing.h"

// The emulated firmware's less frequent commands: retraction, leveling, filament change, objects, SD card,
// jerk.

namespace {

using namespace lamina::transport;
using namespace std::chrono_literals;

EmulatorOptions everything() {
  EmulatorOptions options = lamina::tests::hot_printer();
  FirmwareFeatures& features = options.features;
  features.host_actions = features.emergency_parser = features.sd_card = features.firmware_retraction = true;
  features.leveling = features.filament_change = features.cancel_objects = true;
  options.serial.busy_interval = 0s;
  return options;
}

struct Talk : lamina::tests::EmulatorTalk {
  explicit Talk(const EmulatorOptions& options = everything()) : EmulatorTalk(options) {}

  std::string say(const std::string& bytes, Duration listen = 60s) {
    return EmulatorTalk::say(bytes, listen);
  }
};

const std::string kPrompt = "//action:prompt_end\n//action:prompt_begin ";

}  // namespace

TEST_CASE("firmware: G10 and G11 move the filament and not its coordinate") {
  Talk talk;
  talk.say("M83\nG1 X10 E1 F3000\n");
  talk.say("G10\nG10\n");
  CHECK(talk.printer.report().filament_fed == Approx(1 - 3));
  talk.say("G11\n");
  CHECK(talk.printer.report().filament_fed == Approx(1));
  CHECK(talk.printer.report().filament == Approx(1));
  CHECK_THAT(talk.say("M114\n"), Catch::Contains("E:1.00"));
  talk.say("M207 S1.5\nG10\n");
  CHECK(talk.printer.report().filament_fed == Approx(-0.5));
  EmulatorOptions without = everything();
  without.features.firmware_retraction = false;
  CHECK(Talk(without).say("G10\n") == "echo:Unknown command: \"G10\"\nok\n");
}

TEST_CASE(
    "firmware: a line with M110 in it runs its first command, whatever its number, and gives that number") {
  Talk talk;
  const auto framed = [](LineNumber number, const std::string& command) {
    return frame_line(number, command, {false});
  };
  talk.say(framed(1, "G92X5Y6Z7") + framed(2, "M105"));
  const std::string place = talk.say(framed(2, "M114M110N2"));
  CHECK(place.starts_with("X:5.00 Y:6.00 Z:7.00 E:0.00 Count"));
  CHECK(place.ends_with("\nok\n"));
  CHECK(talk.printer.last_line() == 2);
  CHECK(talk.printer.report().doubled_lines == 0);
  // Its sum is looked at.
  std::string damaged = framed(2, "M114M110N2");
  damaged[3] = '5';
  CHECK(talk.say(damaged).starts_with("Error:checksum mismatch, Last Line: 2\n"));
  CHECK(talk.say(framed(3, "M105")).starts_with("ok T:"));
}

TEST_CASE("firmware: G29 takes its time and tells a grid") {
  Talk talk;
  CHECK(talk.say("G29\n", 10s).empty());
  const std::string told = talk.say("", 60s);
  CHECK_THAT(told, Catch::StartsWith("Bilinear Leveling Grid:\n"));
  CHECK_THAT(told, Catch::EndsWith("ok\n"));
}

TEST_CASE("firmware: M0 asks the host, and goes on with M108 or an answer") {
  const std::string go_on = GENERATE("M108\n", "M876 S0\n");
  Talk talk;
  CHECK(talk.say("M0\n") == kPrompt + "M0 Stop\n//action:prompt_button Continue\n//action:prompt_show\n");
  CHECK(talk.say("", 1h).empty());
  CHECK(talk.say(go_on) == "ok\nok\n");  // of M0, and of the command itself
}

TEST_CASE("firmware: M600 changes the filament with the user") {
  Talk talk;
  talk.say("G28\n", 10min);
  const std::string first = talk.say("M600\n", 2min);
  CHECK_THAT(first, Catch::StartsWith("//action:paused\n" + kPrompt + "Pause\n"));
  CHECK_THAT(first,
             Catch::Contains("echo:Insert filament and send M108\n") && Catch::Contains("Nozzle Parked"));
  CHECK_THAT(first, !Catch::Contains("ok\n"));
  const std::string second = talk.say("M108\n", 1min);
  CHECK_THAT(second, Catch::Contains("PurgeMore"));
  CHECK_THAT(second, !Catch::Contains("ok\n"));
  CHECK(talk.say("M876 S1\n") == "//action:prompt_end\n//action:resumed\nok\nok\nok\n");
}

TEST_CASE("firmware: a cancelled object is not printed") {
  Talk talk;
  talk.say(
      "M83\nM486 T2\nM486 S0\nG1 X10 E1 F3000\nM486 S1\nG1 X20 E1\nM486 P1\nG1 X30 E1\nM486 S0\nG1 X40 E1\n");
  CHECK(talk.printer.report().beads == 3);
  CHECK(talk.printer.beads().back().from[0] == 20);  // as if the skipped move had not been
}

TEST_CASE("firmware: the SD card lists, prints, pauses and forgets") {
  Talk talk;
  talk.printer.card().put("a.gco", "M83\nG1 X10 E1 F600\nG1 X20 E1 ; up\n\nG1 X30 E1\n");
  CHECK(talk.say("M20\n") == "Begin file list\nA.GCO 45\nEnd file list\nok\n");
  CHECK(talk.say("M27\n") == "Not SD printing\nok\n");
  CHECK(talk.say("M23 b.gco\n") == "open failed, File: b.gco.\nok\n");
  CHECK(talk.say("M23 a.gco\n") ==
        "echo:Now fresh file: a.gco\nFile opened: a.gco Size: 45\nFile selected\nok\n");
  CHECK(talk.say("M24\n") == "ok\nDone printing file\n");
  CHECK(talk.printer.report().beads == 3);
  CHECK(talk.say("M30 a.gco\n") == "File deleted:a.gco\nok\n");
  CHECK(talk.say("M20\n") == "Begin file list\nEnd file list\nok\n");
}

TEST_CASE("firmware: an upload to the card takes numbered lines only, and keeps them") {
  Talk talk;
  std::string written;
  CHECK(talk.say("N0 M110 N0*125\n") == "ok\n");
  CHECK(talk.say(frame_line(1, "M28 up.gco")) == "Writing to file: up.gco\nok\n");
  CHECK(talk.say(frame_line(2, "G1 X10 F600")) == "ok\n");
  CHECK_THAT(talk.say("G1 X20\n"),
             Catch::StartsWith("Error:No Checksum with line number, Last Line: 2\nResend: 3\n"));
  CHECK_THAT(talk.say("N3 G1 X30*1\n"), Catch::StartsWith("Error:checksum mismatch, Last Line: 2\n"));
  CHECK(talk.say(frame_line(3, "M112")) == "ok\n");  // stored, not obeyed
  CHECK(talk.say(frame_line(4, "M29")) == "Done saving file.\nok\n");
  CHECK_FALSE(talk.printer.halted());
  CHECK(talk.printer.card().files().at("UP.GCO") == "G1 X10 F600\nM112\n");
  CHECK(talk.printer.report().moves == 0);
}

TEST_CASE("firmware: a slow card starves the planner, and a print from it can be aborted") {
  EmulatorOptions options = everything();
  options.faults = {parse_fault_order("slow-card=1@command:0")};
  Talk talk(options);
  std::string file = "M83\n";
  for (int i = 1; i <= 50; ++i) file += "G1 X" + std::to_string(i % 2) + " E0.1 F6000\n";
  talk.printer.card().put("A.GCO", file);
  talk.say("M32 A.GCO\n", 20s);
  CHECK(talk.printer.report().underruns > 10);
  CHECK_THAT(talk.say("M27\n", 0s), Catch::StartsWith("SD printing byte "));
  talk.say("M524\n", 60s);
  CHECK(talk.printer.report().beads < 30);
  CHECK(talk.printer.idle());
}

TEST_CASE("firmware: the longest ooze is told, and a retraction ends the pressure") {
  Talk talk;
  talk.say("M83\nG1 X10 E1 F600\n", 30s);
  talk.say("G1 X20 E1\n", 30s);
  // A move of 10 mm at 10 mm/s is over after a second or so.
  CHECK(to_seconds(talk.printer.report().longest_ooze) == Approx(29).margin(0.5));
  talk.say("G1 E-1 F1800\n", 10min);
  talk.say("G1 X30\n");
  CHECK(to_seconds(talk.printer.report().longest_ooze) == Approx(29).margin(0.5));
}

TEST_CASE("firmware: with classic jerk a corner is taken at the speed at which no axis jumps by more") {
  MotionOptions motion;
  motion.first_block_delay = 0s;
  motion.minimum_speed = 0;
  motion.min_segment_time = 0s;
  motion.max_acceleration = {1000, 1000, 1000, 1000};
  motion.max_feedrate = {200, 200, 200, 200};
  motion.acceleration = motion.travel_acceleration = 1000;
  motion.jerk = {8, 8, 1, 5};
  Planner planner(motion);
  // Right angle: each axis changes by the whole speed, so the corner is taken at 8 mm/s. From standstill the
  // jerk is the starting speed.
  planner.push({{0, 0, 0, 0}, {50, 0, 0, 0}, 60, 0}, {});
  planner.push({{50, 0, 0, 0}, {50, 50, 0, 0}, 60, 0}, {});
  Instant end{};
  while (const auto next = planner.next_event()) {
    end = *next;
    planner.advance(end);
  }
  const auto move_time = [](double entry, double exit) {
    const double ramps = (60 * 60 - entry * entry) / 2000 + (60 * 60 - exit * exit) / 2000;
    return (60 - entry) / 1000 + (60 - exit) / 1000 + (50 - ramps) / 60;
  };
  CHECK(to_seconds(end.time_since_epoch()) == Approx(move_time(8, 8) + move_time(8, 0)).epsilon(1e-6));
}
