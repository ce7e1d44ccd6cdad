#include <filesystem>
#include <fstream>
#include <string>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program_run.h"

namespace {

using namespace lamina::tests;
using Catch::Matchers::Contains;
using Json = nlohmann::json;

const std::string kBlock = std::string(LAMINA_SOURCE_DIR) + "/tests/golden/block.gcode";

}  // namespace

TEST_CASE("print --trace: the replay of what it writes sends the same bytes") {
  const WorkFolder folder;
  const ProgramRun print =
      run_lamina(folder, "print " + kBlock + " --emulate --time-scale 100 --quiet --trace print.trace");
  INFO(print.err);
  REQUIRE(print.exit_code == 0);
  const ProgramRun replay = run_lamina(folder, "replay print.trace");
  CHECK(replay.exit_code == 0);
  CHECK_THAT(replay.out, Catch::Matchers::StartsWith("same: "));
  const ProgramRun json = run_lamina(folder, "replay print.trace --json");
  CHECK(json.exit_code == 0);
  const Json result = Json::parse(json.out);
  CHECK(result["same"] == true);
  CHECK(result["lines_sent"] == result["lines_acknowledged"]);
  CHECK(result["lines_sent"] > 100);

  // A line that the printer never acknowledged: the engine cannot have gone on.
  std::string text = read_text(folder / "print.trace");
  const std::size_t heard = text.find(" < ok", text.size() / 2);
  REQUIRE(heard != std::string::npos);
  text.replace(heard, 5, " < oh");
  std::ofstream(folder / "changed.trace") << text;
  const ProgramRun changed = run_lamina(folder, "replay changed.trace");
  CHECK(changed.exit_code == 1);
  CHECK_THAT(changed.out, Contains("first difference at ") && Contains("engine    "));
}

TEST_CASE("replay and --trace: what is wrong with a file is said") {
  const WorkFolder folder;
  std::ofstream(folder / "no.trace") << "G28\n";
  for (const std::string file : {"absent.trace", "no.trace"}) {
    const ProgramRun run = run_lamina(folder, "replay " + file);
    CHECK(run.exit_code == 3);
    CHECK_THAT(run.err, Catch::Matchers::StartsWith("error: " + file + ": "));
  }
  const std::string print = "print " + kBlock + " --emulate --quiet --trace ";
  CHECK(run_lamina(folder, print + "x.trace").exit_code == 2);
  const ProgramRun run = run_lamina(folder, print + "absent/x.trace --time-scale 100");
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("absent/x.trace"));
}

TEST_CASE("ports: the list is for people and for programs") {
  const WorkFolder folder;
  const ProgramRun people = run_lamina(folder, "ports");
  CHECK(people.exit_code == 0);
  CHECK(people.err.empty());
  CHECK_FALSE(people.out.empty());
  const ProgramRun programs = run_lamina(folder, "ports --json");
  CHECK(programs.exit_code == 0);
  const Json ports = Json::parse(programs.out);
  REQUIRE(ports.is_array());
  for (const Json& port : ports) {
    CHECK(port["problems"].is_array());
    if (port["path"].is_string()) CHECK_THAT(people.out, Contains(port["path"].get<std::string>()));
  }
}
