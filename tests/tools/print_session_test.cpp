#include <fstream>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program_run.h"

// Printing as a user drives it: broken off and resumed, paused, cancelled, refused, out of a pipe.

using namespace lamina::tests;
using Catch::Contains;
using Json = nlohmann::json;

namespace {

/// Shell: an emulated printer in the background, its path in $PORT; `work` runs with it, and its exit status
/// is the result. The report of the printer is in printer.json.
std::string with_printer(const std::string& work, const std::string& options = "--time-scale 200") {
  return "export XDG_STATE_HOME=\"$PWD/state\"; rm -f printer.txt; "
         "\"$LAMINA\" emulate --json " +
         options +
         " > printer.txt 2> /dev/null & PRINTER=$!; "
         "for i in $(seq 100); do [ -s printer.txt ] && break; sleep 0.05; done; PORT=$(head -1 "
         "printer.txt); " +
         work +
         "; code=$?; kill -TERM $PRINTER; wait $PRINTER; tail -n +2 printer.txt > printer.json; exit $code";
}

void slice_box(const WorkFolder& folder) {
  REQUIRE(run_lamina(folder, "slice " + model_file("box.igs") + " --scale 0.6 -o box.gcode").exit_code == 0);
}

std::vector<Json> events_of(const std::string& text) {
  std::vector<Json> events;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('{')) events.push_back(Json::parse(line));
  }
  return events;
}

bool has_phase(const std::vector<Json>& events, const std::string& phase) {
  return std::any_of(events.begin(), events.end(),
                     [&](const Json& event) { return event["event"] == "phase" && event["phase"] == phase; });
}

}  // namespace

TEST_CASE("a print whose host was killed is resumed, and deposits what it should") {
  const WorkFolder folder;
  slice_box(folder);
  const std::string print = "\"$LAMINA\" print box.gcode --port $PORT --time-scale 200";
  const ProgramRun run = run_shell(
      folder, with_printer("timeout -s KILL 1.2 " + print + " --quiet; " + print + " --resume --json"));
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const Json host = Json::parse(run.out);
  CHECK(host["outcome"] == "completed");
  const Json printer = Json::parse(read_text(folder / "printer.json"));
  const ProgramRun straight = run_lamina(folder, "print box.gcode --emulate --json");
  const Json expected = Json::parse(straight.out);
  CHECK(host["lines_sent"].get<int>() < expected["lines_sent"].get<int>());
  CHECK(printer["beads"] == expected["emulated"]["beads"]);
  CHECK(printer["deposited_mm3"].get<double>() ==
        Approx(expected["emulated"]["deposited_mm3"].get<double>()).epsilon(1e-9));
}

TEST_CASE("resume says what there is to resume, and of what") {
  const WorkFolder folder;
  slice_box(folder);
  std::ofstream(folder / "other.gcode") << "G28\nG1 X1 F600\n";
  const std::string print = "\"$LAMINA\" print box.gcode --quiet --time-scale 200 --port $PORT";
  const ProgramRun nothing = run_shell(folder, with_printer(print + " --resume"));
  CHECK(nothing.exit_code == 3);
  CHECK_THAT(nothing.err, Contains("nothing to resume on /dev/pts/"));
  const ProgramRun other = run_shell(
      folder,
      with_printer("timeout -s KILL 1.2 " + print + "; \"$LAMINA\" print other.gcode --port $PORT --resume"));
  CHECK(other.exit_code == 3);
  CHECK_THAT(other.err, Contains("box.gcode was being printed there"));
  // Another print may begin; it says what is lost by that.
  const ProgramRun anew =
      run_shell(folder, with_printer("timeout -s KILL 1.2 " + print +
                                     "; \"$LAMINA\" print other.gcode --time-scale 200 --port $PORT"));
  CHECK(anew.exit_code == 0);
  CHECK_THAT(anew.err, Contains("box.gcode can no longer be resumed"));
}

TEST_CASE("a printer that has restarted is not simply printed on") {
  const WorkFolder folder;
  slice_box(folder);
  const std::string print = "\"$LAMINA\" print box.gcode --quiet --time-scale 200 --journal journal --port ";
  const ProgramRun first = run_shell(folder, with_printer("timeout -s KILL 1.2 " + print + "$PORT"));
  REQUIRE(first.exit_code == 137);
  // Another printer, as far as its memory goes.
  const ProgramRun refused = run_shell(folder, with_printer(print + "$PORT --resume"));
  CHECK(refused.exit_code == 8);
  CHECK_THAT(refused.err, Contains("--after-restart"));
  const ProgramRun resumed = run_shell(folder, with_printer(print + "$PORT --resume --after-restart --json"));
  INFO(resumed.err);
  CHECK(resumed.exit_code == 0);
  CHECK(Json::parse(read_text(folder / "printer.json"))["cold_extrusions"] == 0);
}

TEST_CASE("the printer may cancel, and the exit code tells") {
  const WorkFolder folder;
  std::ofstream(folder / "print.gcode") << "G28\nM118 A1 action:cancel\nG1 X10 F600\nM117 end\n";
  const ProgramRun run = run_lamina(folder, "print print.gcode --emulate");
  CHECK(run.exit_code == 9);
  CHECK_THAT(run.err, Contains("cancelled at the printer"));
}

TEST_CASE("commands through a pipe pause, resume and cancel a print; events tell") {
  const WorkFolder folder;
  slice_box(folder);
  const std::string print =
      "\"$LAMINA\" print box.gcode --quiet --time-scale 50 --port $PORT --events --console commands";
  const ProgramRun run = run_shell(
      folder,
      with_printer("(sleep 2; echo pause > commands; sleep 0.8; echo nonsense > commands; echo 'feed 150' > "
                   "commands; echo resume > commands; sleep 0.5; echo cancel > commands) & " +
                       print,
                   "--time-scale 50"));
  CHECK(run.exit_code == 9);
  CHECK_THAT(run.err, Contains("no such command: 'nonsense'"));
  const std::vector<Json> events = events_of(run.out);
  for (const char* phase : {"Printing", "Parking", "Paused", "Returning", "Cancelling"}) {
    INFO(phase);
    CHECK(has_phase(events, phase));
  }
}

TEST_CASE("a file for another printer is refused, unless forced") {
  const WorkFolder folder;
  std::ofstream(folder / "big.gcode")
      << ";FLAVOR:Marlin\n;MINX:10\n;MINY:10\n;MINZ:0\n;MAXX:290\n;MAXY:100\n;MAXZ:5\nG28\n";
  const ProgramRun refused = run_lamina(folder, "print big.gcode --emulate");
  CHECK(refused.exit_code == 6);
  CHECK_THAT(refused.err, Contains("290.0 mm along X") && Contains("--force"));
  CHECK(run_lamina(folder, "print big.gcode --emulate --force").exit_code == 0);
}

TEST_CASE("G-code comes out of a pipe") {
  const WorkFolder folder;
  slice_box(folder);
  const ProgramRun run = run_shell(folder, "cat box.gcode | \"$LAMINA\" print - --emulate --json");
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  CHECK(Json::parse(run.out)["emulated"] ==
        Json::parse(run_lamina(folder, "print box.gcode --emulate --json").out)["emulated"]);
  CHECK(run_shell(folder, "printf '; nothing\\n' | \"$LAMINA\" print - --emulate").exit_code == 3);
}

TEST_CASE("wrong arguments of print and sd are explained") {
  const WorkFolder folder;
  std::ofstream(folder / "print.gcode") << "G28\n";
  const auto refused = [&](const std::string& arguments, const std::string& reason) {
    const ProgramRun run = run_lamina(folder, arguments);
    INFO(arguments << ": " << run.err);
    CHECK(run.exit_code == 2);
    CHECK_THAT(run.err, Contains(reason));
  };
  refused("print print.gcode --emulate --resume", "need --port");
  refused("print print.gcode --port x --after-restart", "needs --resume");
  refused("print print.gcode --port x --no-journal --resume", "excludes");
  refused("print print.gcode --port x --journal-sync often", "never, layer, or seconds");
  refused("print print.gcode --port x --park 5", "two numbers");
  refused("print print.gcode --port x --baud 12.5", "whole number");
  refused("print print.gcode --emulate --console print.gcode", "no named pipe");
  refused("print - --port x --resume", "needs a file");
  refused("sd", "needs --port");
  refused("sd format --port x", "cannot 'format'");
  refused("sd print --port x", "wrong number of arguments");
}
