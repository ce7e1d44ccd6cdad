#include <fstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program_run.h"

using namespace lamina::tests;
using Catch::Contains;
using Json = nlohmann::json;

namespace {

void check_complete(const Json& json) {
  CHECK(json["outcome"] == "completed");
  CHECK(json["lines_sent"].get<int>() > 100);
  CHECK(json["lines_sent"] == json["lines_acknowledged"]);
  CHECK(json["emulated"]["deposited_mm3"].get<double>() ==
        Approx(json["planned_mm3"].get<double>()).epsilon(0.005));
  for (const char* fault : {"cold_extrusions", "too_long_extrusions", "outside_moves", "unknown_commands",
                            "refused_lines", "duplicate_lines", "bytes_lost"}) {
    INFO(fault);
    CHECK(json["emulated"][fault] == 0);
  }
}

}  // namespace

TEST_CASE("a G-code file and its model print the same on the emulated printer") {
  const WorkFolder folder;
  const std::string options = " -q draft -s infill.density=10";
  REQUIRE(run_lamina(folder, "slice " + model_file("box.igs") + options + " -o box.gcode").exit_code == 0);
  const ProgramRun file = run_lamina(folder, "print box.gcode --emulate --json");
  REQUIRE(file.exit_code == 0);
  const Json of_file = Json::parse(file.out);
  check_complete(of_file);
  CHECK(of_file["layers"] == 36);  // 10 mm / 0.28 mm, rounded up

  const ProgramRun model =
      run_lamina(folder, "print " + model_file("box.igs") + options + " --emulate --json");
  REQUIRE(model.exit_code == 0);
  const Json of_model = Json::parse(model.out);
  check_complete(of_model);
  CHECK(of_model["lines_sent"] == of_file["lines_sent"]);
  CHECK(of_model["emulated"] == of_file["emulated"]);
}

TEST_CASE("every shipped printer and filament prints on its emulation without a fault") {
  const WorkFolder folder;
  for (const std::string printer : {"generic_marlin_220", "ender3", "prusa_mk3s"}) {
    for (const std::string filament : {"pla", "petg"}) {
      INFO(printer << ", " << filament);
      const ProgramRun run =
          run_lamina(folder, "print " + model_file("box.igs") + " --scale 0.3 --emulate --json -p " +
                                 printer + " -f " + filament);
      INFO(run.err);
      CHECK(run.exit_code == 0);
      Json json = Json::parse(run.out);
      // G80 (mesh levelling) and M73 are the MK3S's own; the emulated firmware is stock Marlin.
      if (printer == "prusa_mk3s") json["emulated"]["unknown_commands"] = 0;
      check_complete(json);
    }
  }
}

TEST_CASE("by the clock, a thousand times as fast") {
  const WorkFolder folder;
  const ProgramRun run = run_lamina(
      folder, "print " + model_file("box.igs") + " --scale 0.2 --emulate --time-scale 1000 --json");
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const Json json = Json::parse(run.out);
  CHECK(json["lines_sent"] == json["lines_acknowledged"]);
  CHECK(json["emulated"]["deposited_mm3"].get<double>() ==
        Approx(json["planned_mm3"].get<double>()).epsilon(0.005));
}

TEST_CASE("a print through a pseudo-terminal, from lamina to lamina") {
  const WorkFolder folder;
  const ProgramRun run =
      run_shell(folder,
                "\"$LAMINA\" emulate --once --time-scale 200 --json > emulator.txt 2> /dev/null & "
                "for i in $(seq 100); do [ -s emulator.txt ] && break; sleep 0.05; done; "
                "\"$LAMINA\" print " +
                    model_file("box.igs") +
                    " --scale 0.2 --port \"$(head -1 emulator.txt)\" --json; "
                    "code=$?; wait; exit $code");
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const Json host = Json::parse(run.out);
  CHECK(host["lines_sent"] == host["lines_acknowledged"]);
  const std::string report = read_text(folder / "emulator.txt");
  const Json printer = Json::parse(report.substr(report.find('\n')));
  CHECK(printer["deposited_mm3"].get<double>() == Approx(host["planned_mm3"].get<double>()).epsilon(0.005));
}

TEST_CASE("Ctrl-C cancels a print and switches the heaters off") {
  const WorkFolder folder;
  const ProgramRun run = interrupt_lamina(
      folder, "print " + model_file("box.igs") + " --emulate --time-scale 50", "Printing", "INT");
  CHECK(run.exit_code == 130);
  CHECK_THAT(run.err, Contains("cancelled; heaters are off\n"));
}

TEST_CASE("a port with nothing behind it is told apart from a printer that fails") {
  const WorkFolder folder;
  std::ofstream(folder / "plain.txt") << "no device";
  const ProgramRun run = run_lamina(folder, "print " + model_file("box.igs") + " --port plain.txt");
  CHECK(run.exit_code == 7);
}
