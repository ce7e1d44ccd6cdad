// Models on the bed: turned, scaled, several, as the G-code shows it.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program_run.h"

using namespace lamina::tests;
using Catch::Contains;
using Json = nlohmann::json;

namespace {

/// x, y and z reach of the moves of outer walls.
struct Reach {
  double low[3] = {1e9, 1e9, 1e9};
  double high[3] = {-1e9, -1e9, -1e9};
  double size(int axis) const { return high[axis] - low[axis]; }
  double middle(int axis) const { return 0.5 * (low[axis] + high[axis]); }
};

Reach walls_of(const std::string& gcode) {
  Reach reach;
  std::istringstream lines(gcode);
  bool wall = false;
  double at[3] = {0.0, 0.0, 0.0};
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(";TYPE:", 0) == 0) wall = line.find("External perimeter") != std::string::npos;
    if (line.rfind("G0", 0) != 0 && line.rfind("G1", 0) != 0) continue;
    const std::string words = line.substr(0, line.find(';'));
    for (int axis = 0; axis < 3; ++axis) {
      const auto place = words.find(" XYZ"[axis + 1]);
      if (place != std::string::npos) at[axis] = std::strtod(words.c_str() + place + 1, nullptr);
    }
    if (!wall || words.find('E') == std::string::npos) continue;
    for (int axis = 0; axis < 3; ++axis) {
      reach.low[axis] = std::min(reach.low[axis], at[axis]);
      reach.high[axis] = std::max(reach.high[axis], at[axis]);
    }
  }
  return reach;
}

Reach sliced(const WorkFolder& folder, const std::string& arguments) {
  const ProgramRun run = run_lamina(folder, "slice " + arguments + " -o part.gcode --force --quiet");
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  return walls_of(read_text(folder / "part.gcode"));
}

constexpr double kBead = 0.5;  // walls run half a bead inside

}  // namespace

TEST_CASE("a turned model has its sides exchanged") {
  const WorkFolder folder;
  const std::string box = model_file("box.igs");  // 20 x 15 x 10
  const Reach flat = sliced(folder, box);
  CHECK(flat.size(0) == Approx(20.0).margin(kBead));
  CHECK(flat.size(1) == Approx(15.0).margin(kBead));
  CHECK(flat.high[2] == Approx(10.0).margin(0.01));
  const Reach turned = sliced(folder, box + " --rotate 90");
  CHECK(turned.size(0) == Approx(15.0).margin(kBead));
  CHECK(turned.size(1) == Approx(20.0).margin(kBead));
  const Reach standing = sliced(folder, box + " --rotate 90,0,0");
  CHECK(standing.size(0) == Approx(20.0).margin(kBead));
  CHECK(standing.size(1) == Approx(10.0).margin(kBead));
  CHECK(standing.high[2] == Approx(15.0).margin(0.01));
}

TEST_CASE("scale to fit: the largest size within, centre where asked") {
  const WorkFolder folder;
  const Reach reach = sliced(folder, model_file("box.igs") + " --scale-to-fit 40,60,90 --center 60,70");
  CHECK(reach.size(0) == Approx(40.0).margin(kBead));
  CHECK(reach.size(1) == Approx(30.0).margin(kBead));
  CHECK(reach.high[2] == Approx(20.0).margin(0.01));
  CHECK(reach.middle(0) == Approx(60.0).margin(0.02));
  CHECK(reach.middle(1) == Approx(70.0).margin(0.02));
}

TEST_CASE("copies and several models lie apart on the bed and use as much filament as alone") {
  const WorkFolder folder;
  const auto filament = [&](const std::string& arguments) {
    const ProgramRun run =
        run_lamina(folder, "slice " + arguments +
                               " -o part.gcode --force --quiet --json -s adhesion.skirt_loops=0 "
                               "-s infill.density=0 -s shell.top_layers=0 -s shell.bottom_layers=0");
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    return Json::parse(run.out)["filament_cm3"].get<double>();
  };
  const std::string box = model_file("box.igs");
  const std::string ball = model_file("sphere_r10.igs");
  // What one part more takes; the first one also has the priming of the nozzle, once a print.
  const double two_boxes = filament(box + " --copies 2");
  const double three_boxes = filament(box + " --copies 3");
  const double a_box = three_boxes - two_boxes;
  const double a_ball = filament(ball + " --copies 3") - filament(ball + " --copies 2");
  CHECK(a_box > 0.4 * two_boxes);
  CHECK(filament(box + " --copies 4") == Approx(three_boxes + a_box).epsilon(1e-4));
  CHECK(filament(box + " " + ball) == Approx(two_boxes - a_box + a_ball).epsilon(0.005));
  const Reach three = sliced(folder, box + " --copies 3 --spacing 10");
  CHECK(three.size(0) == Approx(3 * 20.0 + 2 * 10.0).margin(kBead));
}

TEST_CASE("what does not fit is refused, what is impossible too") {
  const WorkFolder folder;
  const auto exit_code = [&](const std::string& arguments) {
    return run_lamina(folder, "slice " + model_file("box.igs") + " --quiet " + arguments).exit_code;
  };
  CHECK(exit_code("--copies 500") == 6);
  CHECK(exit_code("--scale 50") == 6);
  CHECK(exit_code("--copies 0") == 2);
  CHECK(exit_code("--rotate 1,2") == 2);
  CHECK(exit_code("--scale-to-fit 10,0,10") == 2);
  CHECK(exit_code("--scale 2 --scale-to-fit 10,10,10") == 2);
  CHECK(exit_code("--copies 2 --center 50,50") == 2);
  CHECK(folder.files().empty());
  const ProgramRun tiny = run_lamina(folder, "slice " + model_file("box.igs") + " --scale 0.01 --quiet");
  CHECK_THAT(tiny.err, Contains("is its unit right?"));
}
