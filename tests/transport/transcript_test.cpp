#include <string>

#include <catch2/catch.hpp>

#include "transport/emulator/emulator.h"
#include "transport/protocol/line_framing.h"

// The emulator against what a real Marlin 2.1.2.1 answered, byte for byte. The build that was recorded had
// ADVANCED_OK, the emergency parser, host actions, arcs and Bezier curves, and a room of 20.62 degrees.

namespace {

using namespace lamina::transport;
using namespace std::chrono_literals;

EmulatorOptions full_build() {
  EmulatorOptions options;
  options.features = {true, true, true, true, true, true, true};
  options.thermal.room = 20.62;
  options.greet = false;
  return options;
}

/// A conversation: say something, hear what comes back at once or within a time.
class Talk {
 public:
  explicit Talk(const EmulatorOptions& options = full_build()) : printer(options, Instant{}) {}

  std::string say(const std::string& bytes, Duration listen = 0s) {
    REQUIRE(printer.receive(bytes, now) == bytes.size());
    return hear(listen);
  }

  std::string hear(Duration listen) {
    now += listen;
    printer.advance(now);
    return printer.take_output();
  }

  Instant now{};
  Emulator printer;
};

const std::string kPosition = "X:50.00 Y:50.00 Z:5.00 E:0.00 Count X:4000 Y:4000 Z:2000\n";

/// A talk that has come as far as line 6 of the recording.
Talk talk_at_line_5() {
  Talk talk;
  talk.say("N0 M110 N0*125\n");
  talk.say(frame_line(1, "G90"));
  talk.say(frame_line(2, "G21"));
  talk.say("N3 G1 X50 Y50 Z5 F6000*5\n");
  talk.say("N4 M400*35\n", 60s);
  talk.say("N5 M114*34\n");
  return talk;
}

}  // namespace

TEST_CASE("transcript: a numbered session is answered like Marlin's") {
  Talk talk;
  CHECK(talk.say("N0 M110 N0*125\n") == "ok N0 P15 B3\n");
  // The recording does not show lines 1 and 2.
  CHECK(talk.say(frame_line(1, "G90")) == "ok N1 P15 B3\n");
  CHECK(talk.say(frame_line(2, "G21")) == "ok N2 P15 B3\n");
  CHECK(talk.say("N3 G1 X50 Y50 Z5 F6000*5\n") == "ok N3 P14 B3\n");
  CHECK(talk.say("N4 M400*35\n").empty());
  CHECK(talk.hear(60s) == "ok N4 P15 B3\n");
  CHECK(talk.say("N5 M114*34\n") == kPosition + "ok N5 P15 B3\n");
}

TEST_CASE("transcript: lines received again are dropped without a word") {
  Talk talk = talk_at_line_5();
  CHECK(talk.say("N5 M114*34\n").empty());
  CHECK(talk.say("N4 M400*35\n").empty());
  CHECK(talk.printer.report().duplicate_lines == 2);
}

TEST_CASE("transcript: damaged lines are refused in Marlin's words") {
  Talk talk = talk_at_line_5();
  const std::string not_next = "Error:Line Number is not Last Line Number+1, Last Line: 5\nResend: 6\nok\n";
  CHECK(talk.say("N3 M114*36\n") == not_next);
  CHECK(talk.say("N7 M114*32\n") == not_next);
  CHECK(talk.say("N6 M114*1\n") == "Error:checksum mismatch, Last Line: 5\nResend: 6\nok\n");
  CHECK(talk.say("N6 M114\n") == "Error:No Checksum with line number, Last Line: 5\nResend: 6\nok\n");
  CHECK(talk.say("N6 M114*33\n") == kPosition + "ok N6 P15 B3\n");
  CHECK(talk.say("N7 G1 X60 ; comment*25\n") ==
        "Error:No Checksum with line number, Last Line: 6\nResend: 7\nok\n");
  CHECK(talk.printer.report().refused_lines == 5);
}

TEST_CASE("transcript: a line end completes what lies in the buffer, and nothing else") {
  Talk talk;
  CHECK(talk.say("N1 G1 X1*96").empty());
  // Glued to line 1, the M105 is behind the digits of its checksum and vanishes.
  CHECK(talk.say("M105\n") == "ok N1 P14 B3\n");
  talk.say("", 10s);
  CHECK(talk.say("N2 G1 X2*96").empty());
  CHECK(talk.say("\n") == "ok N2 P14 B3\n");
  CHECK(talk.say("\n\n\r\n").empty());
}

TEST_CASE("transcript: the state probe runs nothing and tells the last line") {
  Talk talk = talk_at_line_5();
  const auto lines_run = talk.printer.report().lines_run;
  CHECK(talk.say("N2000000000 M105*21\n") ==
        "Error:Line Number is not Last Line Number+1, Last Line: 5\nResend: 6\nok\n");
  CHECK(talk.printer.report().lines_run == lines_run);
}

TEST_CASE("transcript: curves fill the planner") {
  Talk talk;
  talk.say("G1 X2 F6000\n", 10s);
  // A Bezier curve of 14 chords into an empty planner.
  CHECK(talk.say("G5 X20 Y20 I0 J10 P0 Q-10 F3000\n") == "ok P1 B3\n");
  talk.hear(60s);
  // A semicircle of radius 10 has 36 chords; its ok comes when the last one has a place, with the next line
  // queued.
  CHECK(talk.say("G2 X40 Y20 I10 J0\nG2 X10\n").empty());
  CHECK(talk.hear(60s) == "ok P0 B2\nError:G2/G3 bad parameters\nok P0 B3\n");
}

TEST_CASE("transcript: heating reports once a second, counts the residency down, and is busy in between") {
  Talk talk;
  CHECK(talk.say("M105\n") == "ok T:20.62 /0.00 B:20.62 /0.00 @:0 B@:0\n");
  CHECK(talk.say("M109 S60\n") == " T:20.62 /60.00 B:20.62 /0.00 @:127 B@:0 W:?\n");
  const std::string heard = talk.hear(60s);
  CHECK(heard.find("echo:busy: processing\n") != std::string::npos);
  CHECK(heard.find(" W:9\n") != std::string::npos);
  CHECK(heard.find(" W:0\n") != std::string::npos);
  CHECK(heard.find(" W:9\n") < heard.find(" W:8\n"));
  CHECK(heard.ends_with("ok P15 B3\n"));
  CHECK(heard.find("ok") == heard.size() - 10);
}

TEST_CASE("transcript: M108 ends a wait, and has an ok of its own") {
  Talk talk;
  talk.say("M109 S200\n", 1s);
  CHECK(talk.say("M108\n") == "ok P15 B2\nok P15 B3\n");
}

TEST_CASE("transcript: M112 kills at any time") {
  const std::string killed = "echo:M112 Shutdown\nError:Printer halted. kill() called!\n//action:poweroff\n";
  for (const std::string line : {"M112\n", "N1 M112*32\n", "M112 \n", "M1125\n"}) {
    Talk talk;
    talk.say("G4 S5\nG4 S5\nG4 S5\nG4 S5\n");
    CHECK(talk.say(line) == killed);
    CHECK(talk.printer.halted());
    CHECK(talk.say("M105\n").empty());
  }
  for (const std::string line : {"M117 M112\n", "G1 X1 M112\n"}) {
    Talk talk;
    CHECK(talk.say(line).starts_with("ok"));
    CHECK_FALSE(talk.printer.halted());
  }
}

TEST_CASE("transcript: without the emergency parser M112 waits behind a full queue") {
  EmulatorOptions stock = full_build();
  stock.features = {};
  Talk talk(stock);
  talk.say("G4 S5\nG4 S5\nG4 S5\nG4 S5\n");
  CHECK(talk.say("M112\n").empty());
  CHECK(talk.hear(4900ms) == "echo:busy: processing\necho:busy: processing\n");
  CHECK(talk.hear(200ms) == "ok\necho:M112 Shutdown\nError:Printer halted. kill() called!\n");
  // With a number it waits its turn like any other command.
  Talk numbered(stock);
  numbered.say("G4 S5\n");
  CHECK(numbered.say("N1 M112*32\n").empty());
}

TEST_CASE("transcript: a burst with a damaged line is cut off there") {
  EmulatorOptions stock = full_build();
  stock.features = {};
  Talk talk(stock);
  std::string burst;
  for (int line = 1; line <= 8; ++line) {
    std::string framed = frame_line(line, "G1 X" + std::to_string(line));
    if (line == 3) framed[4] = 'F';
    burst += framed;
  }
  // The error overtakes the oks of lines 1 and 2; the rest was flushed.
  CHECK(talk.say(burst) == "Error:checksum mismatch, Last Line: 2\nResend: 3\nok\nok\nok\n");
}

TEST_CASE("transcript: unknown commands are acknowledged") {
  EmulatorOptions stock = full_build();
  stock.features = {};
  Talk talk(stock);
  CHECK(talk.say("G12345\n") == "echo:Unknown command: \"G12345\"\nok\n");
  CHECK(talk.say("4 G1 X4*77\n") == "echo:Unknown command: \"4 G1 X4\"\nok\n");
  CHECK(talk.say("n5 M105*1\n") == "echo:Unknown command: \"n5 M105\"\nok\n");
  CHECK(talk.say(std::string("\0\0M105\n", 7)) == "echo:Unknown command: \"\"\nok\n");
  CHECK(talk.say("M104 T1 S200\n") == "echo:M104 Invalid extruder 1\nok\n");
  CHECK(talk.say("T1\n") == "echo:T1 Invalid extruder\nok\n");
  CHECK(talk.say("M105*1\n") == "ok T:20.62 /0.00 B:20.62 /0.00 @:0 B@:0\n");
}

TEST_CASE("transcript: line numbers can be set") {
  EmulatorOptions stock = full_build();
  stock.features = {};
  Talk talk(stock);
  CHECK(talk.say("N50 M110*22\n") == "ok\n");
  CHECK(talk.printer.last_line() == 50);
  CHECK(talk.say("N-5 M110 N-5*125\n") == "ok\n");
  CHECK(talk.printer.last_line() == -5);
  CHECK(talk.say("M110 N7\n") == "ok\n");
  CHECK(talk.printer.last_line() == 7);
  CHECK(talk.say("M110\n") == "ok\n");
  CHECK(talk.printer.last_line() == 7);
  talk.say("M110 N0\n");
  CHECK(talk.say("M999\n") == "Resend: 1\nok\nok\n");
}

TEST_CASE("transcript: a line longer than the buffer is cut") {
  EmulatorOptions stock = full_build();
  stock.features = {};
  Talk talk(stock);
  const std::string text(90, 'A');
  CHECK(talk.say("N1 M117 " + text + "*10\n") ==
        "Error:No Checksum with line number, Last Line: 0\nResend: 1\nok\n");
  CHECK(talk.say("G1 X7.5Y3E0.1\n") == "echo: cold extrusion prevented\nok\n");
}

TEST_CASE("transcript: busy lines come every two seconds, and M113 changes that") {
  EmulatorOptions stock = full_build();
  stock.features = {};
  Talk talk(stock);
  CHECK(talk.say("M113\n") == "echo:M113 S2\nok\n");
  talk.say("G4 S5\n");
  CHECK(talk.hear(1900ms).empty());
  CHECK(talk.hear(200ms) == "echo:busy: processing\n");
  CHECK(talk.hear(2s) == "echo:busy: processing\n");
  CHECK(talk.hear(1s) == "ok\n");
  CHECK(talk.say("M113 S0\nG4 S5\n") == "ok\n");
  CHECK(talk.hear(6s) == "ok\n");
}
