#include "transport/session/machine_state.h"

#include <catch2/catch.hpp>

#include "transport/protocol/command_words.h"

using namespace lamina::transport;

namespace {

MachineState run(std::initializer_list<const char*> commands) {
  MachineState state;
  for (const char* command : commands) state = after(std::move(state), command);
  return state;
}

}  // namespace

TEST_CASE("machine state: absolute and relative moves, with and without blanks") {
  const MachineState state = run({"G28", "G1 X10 Y20 Z.3 F1200", "G91", "G1X-2.5Y5", "G90", "G1 Z1"});
  CHECK(*state.position[0] == Approx(7.5));
  CHECK(*state.position[1] == Approx(25));
  CHECK(*state.position[2] == Approx(1));
  CHECK(*state.feedrate == Approx(1200));
  CHECK_FALSE(state.relative);
  CHECK(state.homed == std::array<bool, 3>{true, true, true});
}

TEST_CASE("machine state: a place is unknown until a move names it") {
  CHECK_FALSE(run({"G28"}).position[0]);
  CHECK_FALSE(run({"G91", "G1 X5"}).position[0]);
  CHECK_FALSE(run({"G1 X5 Y5", "G27"}).position[0]);
  CHECK(run({"G92 Z4"}).position[2] == 4.0);
  CHECK(run({"G92"}).position[0] == 0.0);
}

TEST_CASE("machine state: filament is counted through every way of naming it") {
  // 5 forward, 1 back, G92, 2 forward, then relative: 0.5 forward.
  const MachineState state =
      run({"M82", "G92 E0", "G1 E5", "G1 E4", "G92 E0", "G1 E2", "M83", "G1 E.5", "G92 E100"});
  CHECK(state.e_total == Approx(5 - 1 + 2 + 0.5));
  CHECK(state.e_peak == Approx(6.5));
  CHECK(state.e == Approx(100));
  CHECK(state.extruder_relative);
  // G91 makes the extruder relative, G90 absolute, M83 behind it relative again.
  CHECK(run({"G91"}).extruder_relative);
  CHECK_FALSE(run({"M83", "G90"}).extruder_relative);
  CHECK(run({"G90", "M83"}).extruder_relative);
}

TEST_CASE("machine state: inches") {
  const MachineState state = run({"G20", "G1 X1 F10", "G21", "G1 Y10"});
  CHECK(*state.position[0] == Approx(25.4));
  CHECK(*state.position[1] == Approx(10));
  CHECK(*state.feedrate == Approx(254));
}

TEST_CASE("machine state: heaters, fans, percentages, tools, settings") {
  const MachineState state =
      run({"M140 S60", "M104 S200", "M109 R210", "T1", "M104 S180", "M104 T0 S0", "M106 S128", "M106 P1 S10",
           "M107", "M220 S80", "M221 S95", "M204 P500", "M204 T700", "M190 S65"});
  CHECK(state.nozzles == std::map<int, double>{{0, 0}, {1, 180}});
  CHECK(state.bed == 65);
  CHECK(state.tool == 1);
  CHECK(state.fans == std::map<int, int>{{0, 0}, {1, 10}});
  CHECK(settings_commands(state) ==
        std::vector<std::string>{"M204 P500 T700", "M220 S80", "M221 S95", "M106 P0 S0", "M106 P1 S10"});
}

TEST_CASE("command words: numbers as G-code writes them") {
  const CommandWords words("G1X-.5Y+3E0.1F1200");
  CHECK(words.code() == "G1");
  CHECK(words.number('X') == -0.5);
  CHECK(words.number('Y') == 3.0);
  CHECK(words.number('E') == 0.1);  // 3E0.1 is no exponent
  CHECK_FALSE(words.number('Z'));
  CHECK(number_text(-0.0000001) == "0");
  CHECK(number_text(12.5) == "12.5");
  CHECK(number_text(1e6) == "1000000");
}
