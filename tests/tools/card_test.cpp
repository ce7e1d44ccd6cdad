#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program_run.h"

// The card in an emulated printer, worked with over a pseudo-terminal as a user does.

using namespace lamina::tests;
using Catch::Contains;
using Json = nlohmann::json;

TEST_CASE("a file is uploaded to the printer's card, listed, printed, watched and deleted") {
  const WorkFolder folder;
  REQUIRE(run_lamina(folder, "slice " + model_file("box.igs") + " --scale 0.6 -o box.gcode").exit_code == 0);
  const std::string sd = "\"$LAMINA\" sd --time-scale 10 --port $PORT --quiet ";
  const ProgramRun run = run_shell(
      folder,
      "\"$LAMINA\" emulate --json --firmware sd-card --time-scale 200 > printer.txt 2> /dev/null & "
      "PRINTER=$!; "
      "for i in $(seq 100); do [ -s printer.txt ] && break; sleep 0.05; done; PORT=$(head -1 printer.txt); " +
          sd + "upload box.gcode > upload.txt && " + sd + "list --json > list.json && " + sd +
          "print BOX.GCO && " + sd +
          "progress --json > progress.json && "
          "for i in $(seq 400); do " +
          sd +
          "progress --json > now.json && grep -q false now.json && break; "
          "sleep 0.05; done; " +
          sd + "delete BOX.GCO && " + sd +
          "list; code=$?; "
          "kill -TERM $PRINTER; wait $PRINTER; tail -n +2 printer.txt > printer.json; exit $code");
  INFO(run.out << run.err);
  REQUIRE(run.exit_code == 0);
  CHECK_THAT(run.out, Contains("printing BOX.GCO from the card"));
  CHECK_THAT(run.out, Contains("deleted BOX.GCO"));
  CHECK_THAT(run.out, Contains("the card is empty"));
  CHECK_THAT(read_text(folder / "upload.txt"), Contains("uploaded box.gcode as BOX.GCO"));
  const Json list = Json::parse(read_text(folder / "list.json"));
  REQUIRE(list.size() == 1);
  CHECK(list[0]["name"] == "BOX.GCO");
  const Json progress = Json::parse(read_text(folder / "progress.json"));
  CHECK(progress["printing"] == true);
  CHECK(progress["bytes"] == list[0]["bytes"]);
  CHECK(Json::parse(read_text(folder / "now.json"))["printing"] == false);
  // What the card printed is what the host would have printed.
  const Json printer = Json::parse(read_text(folder / "printer.json"));
  const Json expected = Json::parse(run_lamina(folder, "print box.gcode --emulate --json").out);
  CHECK(printer["beads"] == expected["emulated"]["beads"]);
  CHECK(printer["deposited_mm3"].get<double>() ==
        Approx(expected["emulated"]["deposited_mm3"].get<double>()).epsilon(1e-9));
}
