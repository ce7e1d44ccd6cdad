#include <cmath>
#include <map>
#include <numbers>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program_run.h"

using namespace lamina::tests;
using Catch::Contains;
using Catch::StartsWith;
using Json = nlohmann::json;

namespace {

struct Row {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  int contour = 0;
  int layer = 0;
  std::string kind;
};

std::vector<Row> parse_csv(const std::string& text) {
  std::istringstream stream(text);
  std::string line;
  std::getline(stream, line);
  REQUIRE(line == "x,y,z,contour,layer,kind");
  std::vector<Row> rows;
  while (std::getline(stream, line)) {
    std::vector<std::string> cells;
    std::istringstream cells_of(line);
    for (std::string cell; std::getline(cells_of, cell, ',');) cells.push_back(cell);
    REQUIRE(cells.size() == 6);
    rows.push_back({std::stod(cells[0]), std::stod(cells[1]), std::stod(cells[2]), std::stoi(cells[3]),
                    std::stoi(cells[4]), cells[5]});
  }
  return rows;
}

}  // namespace

TEST_CASE("single heights: a sphere's circles, in the model's own coordinates") {
  const WorkFolder folder;
  const ProgramRun run =
      run_lamina(folder, "contours " + model_file("sphere_r10.igs") + " --at 10,4.5 --json");
  REQUIRE(run.exit_code == 0);
  const Json json = Json::parse(run.out);
  CHECK(json["model"] == "sphere_r10");
  REQUIRE(json["layers"].size() == 2);
  for (const Json& layer : json["layers"]) {
    const double z = layer["z"].get<double>();
    const double radius = std::sqrt(100.0 - (z - 10.0) * (z - 10.0));
    const double epsilon = 0.05;
    // No farther than the tolerance from the circle: the area within the ring of that width.
    CHECK(std::abs(layer["area"].get<double>() - std::numbers::pi * radius * radius) <
          2.0 * std::numbers::pi * radius * epsilon);
    CHECK(layer["length"].get<double>() == Approx(2.0 * std::numbers::pi * radius).epsilon(0.02));
    CHECK(layer["closed"] == 1);
    CHECK(layer["open"] == 0);
    CHECK(layer["planar_outer"] == 0);
    CHECK(layer["points"] == 0);
  }
  CHECK(json["layers"][0]["z"] == 4.5);  // rising, whatever the order given
}

TEST_CASE("the points of the CSV lie on the sphere, a step apart, on closed contours") {
  const WorkFolder folder;
  const ProgramRun run =
      run_lamina(folder, "contours " + model_file("sphere_r10.igs") +
                             " --layer-height 2 --slice-at middle --csv points.csv --step 0.5");
  REQUIRE(run.exit_code == 0);
  CHECK(run.out == "10 layers, 10 contours\npoints.csv\n");
  const std::vector<Row> rows = parse_csv(read_text(folder / "points.csv"));
  std::map<int, std::vector<Row>> contours;
  for (const Row& row : rows) contours[row.contour].push_back(row);
  REQUIRE(contours.size() == 10);
  int number = 0;
  for (const auto& [contour, points] : contours) {
    CHECK(contour == number);
    CHECK(points.front().layer == number);
    CHECK(points.front().z == Approx(2.0 * number + 1.0));
    ++number;
    REQUIRE(points.size() > 3);
    for (std::size_t i = 0; i < points.size(); ++i) {
      CHECK(points[i].kind == "closed");
      const double radius = std::sqrt(100.0 - (points[i].z - 10.0) * (points[i].z - 10.0));
      CHECK(std::hypot(points[i].x, points[i].y) == Approx(radius).margin(0.0025));
      if (i == 0) continue;
      CHECK(std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y) <= 0.5001);
    }
    CHECK(points.front().x == Approx(points.back().x).margin(1e-6));
    CHECK(points.front().y == Approx(points.back().y).margin(1e-6));
  }
}

TEST_CASE("kinds: the top of a sphere is a point, the top of a box is planar") {
  const WorkFolder folder;
  const ProgramRun sphere =
      run_lamina(folder, "contours " + model_file("sphere_r10.igs") + " --at 20 --csv -");
  REQUIRE(sphere.exit_code == 0);
  const std::vector<Row> top = parse_csv(sphere.out);
  REQUIRE(top.size() == 1);
  CHECK(top[0].kind == "point");
  CHECK(std::hypot(top[0].x, top[0].y) < 0.1);
  CHECK(top[0].z == 20.0);

  const ProgramRun box =
      run_lamina(folder, "contours " + model_file("box.igs") + " --at 10 --csv - --step 1");
  REQUIRE(box.exit_code == 0);
  const std::vector<Row> lid = parse_csv(box.out);
  REQUIRE(lid.size() > 60);  // 70 mm around
  for (const Row& row : lid) CHECK(row.kind == "planar-outer");
}

TEST_CASE("one picture per layer") {
  const WorkFolder folder;
  const ProgramRun run =
      run_lamina(folder, "contours " + model_file("box.igs") + " --layer-height 2.5 --svg pictures");
  REQUIRE(run.exit_code == 0);
  CHECK(run.out == "4 layers, 4 contours\npictures\n");
  for (const char* name : {"layer_00000.svg", "layer_00003.svg"}) {
    CHECK_THAT(read_text(folder / "pictures" / name), StartsWith("<?xml") || StartsWith("<svg"));
  }
  CHECK(std::distance(std::filesystem::directory_iterator(folder / "pictures"), {}) == 4);
  CHECK(run_lamina(folder, "contours " + model_file("box.igs") + " --at 5 --svg pictures").exit_code == 2);
  CHECK(
      run_lamina(folder, "contours " + model_file("box.igs") + " --at 5 --svg pictures --force").exit_code ==
      0);
}

TEST_CASE("without a choice of output: a table, one line per layer") {
  const WorkFolder folder;
  const ProgramRun run = run_lamina(folder, "contours " + model_file("box.igs") + " --layer-height 2.5");
  REQUIRE(run.exit_code == 0);
  CHECK(std::count(run.out.begin(), run.out.end(), '\n') == 5);
  CHECK_THAT(run.out, Contains("     1     3.7500"));
}

TEST_CASE("the option --scale scales about the model's origin, and a height outside is said to miss") {
  const WorkFolder folder;
  const ProgramRun run =
      run_lamina(folder, "contours " + model_file("box.igs") + " --scale 2 --at 15,25 --json");
  REQUIRE(run.exit_code == 0);
  const Json json = Json::parse(run.out);
  CHECK(json["layers"][0]["area"].get<double>() == Approx(40.0 * 30.0).margin(140.0 * 0.05));
  CHECK(json["layers"][1]["area"] == 0.0);
  CHECK_THAT(run.err, Contains("warning: z = 25 mm misses the model, which reaches from 0 to 20 mm\n"));
}
