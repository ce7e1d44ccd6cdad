#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/geometry/polygon.h"
#include "engine/import/inspect/trimmed_area.h"
#include "engine/import/read_model.h"
#include "engine/import/trim/loop_polygon.h"
#include "engine/import/trim/parameter_loop.h"
#include "tests/engine/import/reading.h"
#include "tests/support/corpus.h"
#include "tests/support/manifest.h"

using namespace lamina::engine;
using namespace lamina::tests;

namespace {

double area_of(const Model& model) {
  double area = 0.0;
  for (const Surface& surface : model.surfaces) area += surface_integrals(surface).area;
  return area;
}

Model read(const std::vector<IgesEntity>& entities) {
  return read_iges(iges_text(entities), "part.igs").model;
}

/// What Model promises of trim loops: closed, outer ones counter-clockwise, holes clockwise, in the domain.
void check_loops(const Model& model) {
  for (const Surface& surface : model.surfaces) {
    INFO("entity " << surface.entity_type << " at directory line " << surface.directory_line);
    const NurbsSurface& s = surface.nurbs;
    std::vector<Loop> polygons;
    for (const TrimLoop& loop : surface.trim) {
      REQUIRE(!loop.curves.empty());
      for (std::size_t i = 0; i < loop.curves.size(); ++i) {
        const Vector2 end = parameter_end(loop.curves[i]);
        const Vector2 next = parameter_start(loop.curves[(i + 1) % loop.curves.size()]);
        CHECK((end - next).norm() < 1e-9 * (1.0 + end.norm()));
      }
      polygons.push_back(loop_polygon(loop.curves));
      // Real files overshoot: hammer.iges by a thousandth.
      const double room = 1e-3 * (s.last_u() - s.first_u() + s.last_v() - s.first_v());
      for (const Vector2& point : polygons.back()) {
        CHECK(point.x() >= s.first_u() - room);
        CHECK(point.x() <= s.last_u() + room);
        CHECK(point.y() >= s.first_v() - room);
        CHECK(point.y() <= s.last_v() + room);
      }
    }
    double largest = 0.0;
    for (const Loop& polygon : polygons) {
      const double area = signed_area(polygon);
      if (std::abs(area) > std::abs(largest)) largest = area;
    }
    if (!polygons.empty()) CHECK(largest > 0.0);  // the largest loop is an outer one
  }
}

const std::string kPoint = "0.,0.,0.,0";
const std::string kUp = "0.,0.,1.";
const std::string kAhead = "1.,0.,0.";
constexpr const char* kPart = "00010000";

/// A circle about the z axis, counter-clockwise or, lying on its back, clockwise.
std::vector<IgesEntity> turned_circle(double radius, double z, std::size_t transform_line, bool clockwise) {
  const std::string start = reals({radius, 0.0, radius, 0.0});
  // A half turn about the x axis: y and z change sign.
  const IgesEntity flip{124, "1.,0.,0.,0.,0.,-1.,0.,0.,0.,0.,-1.,0."};
  return {flip,
          {100, reals({clockwise ? -z : z, 0.0, 0.0}) + "," + start, 0,
           clockwise ? static_cast<int>(transform_line) : 0, kPart}};
}

}  // namespace

TEST_CASE("corpus: trimmed IGES files have the areas and the faces of the manifest") {
  if (!corpus_present()) {
    WARN("the model corpus is missing: skipped");
    return;
  }
  std::size_t files = 0;
  for (const ManifestRow& cells : manifest_rows({".ig"})) {
    const bool is_trimmed =
        cells[5].find("14") != std::string::npos || cells[5].find("510:") != std::string::npos ||
        cells[5].find("408:") != std::string::npos || cells[5].find("108:") != std::string::npos;
    if (!is_trimmed) continue;
    const std::string& file = cells[1];
    INFO(file);
    const ImportResult result = read_model(corpus_file(file));
    std::size_t faces = std::stoul(cells[6]);
    double area = std::stod(cells[9]);
    // Exceptions, each with its reason.
    if (file == "entities/subfigure_308_408_scaled.igs") {
      faces = 12;  // OpenCASCADE drops the instance of half the size
      area *= 1.25;
    }
    if (file == "real/SOD_323.igs") faces = 71;  // four faces without any area, which are reported
    if (file == "real_fetched/side.iges")
      area = 3.35751964;  // by chords along the directrix; OpenCASCADE's is 0.3 % off
    CHECK(result.model.surfaces.size() == faces);
    CHECK(area_of(result.model) == Approx(area).epsilon(1e-5));
    check_loops(result.model);
    ++files;
  }
  CHECK(files >= 20);
}

TEST_CASE("a cylinder between two circles, without a seam in its loops") {
  for (const bool with_reference : {false, true}) {
    std::vector<IgesEntity> entities = turned_circle(5.0, 2.0, 1, false);  // lines 1, 3
    for (const IgesEntity& entity : turned_circle(5.0, 9.0, 5, true)) entities.push_back(entity);  // 5, 7
    entities.push_back({116, kPoint, 0, 0, kPart});                                                // 9
    entities.push_back({123, kUp, 0, 0, kPart});                                                   // 11
    entities.push_back({123, kAhead, 0, 0, kPart});                                                // 13
    entities.push_back(
        {192, with_reference ? "9,11,5.,13" : "9,11,5.", with_reference ? 1 : 0, 0, kPart});  // 15
    entities.push_back({502, "2,5.,0.,2.,5.,0.,9.", 1, 0, kPart});                            // 17
    entities.push_back({504, "2,3,17,1,17,1,7,17,2,17,2", 1, 0, kPart});                      // 19
    entities.push_back({508, "1,0,19,1,1,0", 1, 0, kPart});                                   // 21
    entities.push_back({508, "1,0,19,2,1,0", 1, 0, kPart});                                   // 23
    entities.push_back({510, "15,2,1,21,23", 1, 0, kPart});                                   // 25
    const Model model = read(entities);
    REQUIRE(model.surfaces.size() == 1);
    CHECK(area_of(model) == Approx(2.0 * M_PI * 5.0 * 7.0).epsilon(1e-9));
    CHECK(model.surfaces[0].trim.empty());  // cut down to the height, nothing is left to trim
    check_loops(model);
  }
}

TEST_CASE("a cap of a sphere: one circle, the pole on its left side") {
  for (const bool clockwise : {false, true}) {
    std::vector<IgesEntity> entities = turned_circle(3.0, 4.0, 1, clockwise);  // 1, 3
    entities.push_back({116, kPoint, 0, 0, kPart});                            // 5
    entities.push_back({196, "5,5.", 0, 0, kPart});                            // 7
    entities.push_back({502, "1,3.,0.,4.", 1, 0, kPart});                      // 9
    entities.push_back({504, "1,3,9,1,9,1", 1, 0, kPart});                     // 11
    entities.push_back({508, "1,0,11,1,1,0", 1, 0, kPart});                    // 13
    entities.push_back({510, "7,1,1,13", 1, 0, kPart});                        // 15
    const Model model = read(entities);
    const double height = clockwise ? 9.0 : 1.0;  // of the cap below or above the circle
    CHECK(area_of(model) == Approx(2.0 * M_PI * 5.0 * height).epsilon(1e-7));
    check_loops(model);
  }
}

TEST_CASE("a patch across the seam of a closed surface") {
  // On a cylinder of radius 1 by 120: the rectangle from -1 to 1 rad, heights 1 to 3, as a loop in space.
  const double c = std::cos(1.0);
  const double s = std::sin(1.0);
  const std::vector<IgesEntity> entities{
      {110, "0.,0.,0.,0.,0.,1.", 0, 0, kPart},                  // 1: axis
      {110, "1.,0.,0.,1.,0.,4.", 0, 0, kPart},                  // 3: generatrix
      {120, "1,3,0.,6.283185307179586", 0, 0, kPart},           // 5
      {100, reals({1.0, 0.0, 0.0, c, -s, c, s}), 0, 0, kPart},  // 7
      {110, reals({c, s, 1.0, c, s, 3.0}), 0, 0, kPart},        // 9
      {100, reals({3.0, 0.0, 0.0, c, -s, c, s}), 0, 0, kPart},  // 11: the wrong way round
      {110, reals({c, -s, 3.0, c, -s, 1.0}), 0, 0, kPart},      // 13
      {102, "4,7,9,11,13", 0, 0, kPart},                        // 15
      {142, "0,5,0,15,2", 0, 0, kPart},                         // 17
      {144, "5,1,0,17"}};
  const Model model = read(entities);
  REQUIRE(model.surfaces.size() == 1);
  CHECK(area_of(model) == Approx(4.0).epsilon(1e-7));
  CHECK(model.surfaces[0].trim.empty());
}

TEST_CASE("parameter curves on arcs mean angles") {
  // A third of a turn of the same cylinder, between angles where no knot is.
  const std::vector<IgesEntity> entities{{110, "0.,0.,0.,0.,0.,1.", 0, 0, kPart},         // 1
                                         {110, "1.,0.,0.,1.,0.,4.", 0, 0, kPart},         // 3
                                         {120, "1,3,0.,6.283185307179586", 0, 0, kPart},  // 5
                                         {110, "0.25,0.3,0.,0.75,0.3,0.", 0, 0, kPart},   // 7
                                         {110, "0.75,0.3,0.,0.75,2.,0.", 0, 0, kPart},    // 9
                                         {110, "0.75,2.,0.,0.25,2.,0.", 0, 0, kPart},     // 11
                                         {110, "0.25,2.,0.,0.25,0.3,0.", 0, 0, kPart},    // 13
                                         {102, "4,7,9,11,13", 0, 0, kPart},               // 15
                                         {142, "0,5,15,0,1", 0, 0, kPart},                // 17
                                         {144, "5,1,0,17"}};
  const Model model = read(entities);
  CHECK(area_of(model) == Approx(1.7 * 2.0).epsilon(1e-9));
}

TEST_CASE("the unit square with holes: any orientation, several outer loops, an island in a hole") {
  const std::string kSquare =
      "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.,0.,1.,0.,1.";
  const auto ring = [](double x0, double x1, double y0, double y1, bool backwards) {
    std::vector<std::array<double, 2>> p{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}};
    if (backwards) std::reverse(p.begin(), p.end());
    std::string text = "2,5";  // 106 with coordinate triples
    for (const auto& q : p) text += "," + reals({q[0], q[1], 0.0});
    return IgesEntity{106, text, 12, 0, kPart};
  };
  for (const bool first_backwards : {false, true}) {
    for (const bool second_backwards : {false, true}) {
      const std::vector<IgesEntity> entities{{128, kSquare, 0, 0, kPart},                 // 1
                                             ring(0.1, 0.9, 0.1, 0.9, first_backwards),   // 3
                                             ring(0.2, 0.8, 0.2, 0.8, second_backwards),  // 5
                                             ring(0.4, 0.6, 0.4, 0.6, first_backwards),   // 7
                                             {142, "0,1,3,0,1", 0, 0, kPart},             // 9
                                             {142, "0,1,5,0,1", 0, 0, kPart},             // 11
                                             {142, "0,1,7,0,1", 0, 0, kPart},             // 13
                                             {144, "1,1,2,9,11,13"}};
      const Model model = read(entities);
      REQUIRE(model.surfaces.size() == 1);
      REQUIRE(model.surfaces[0].trim.size() == 3);
      std::vector<double> areas;
      for (const TrimLoop& loop : model.surfaces[0].trim)
        areas.push_back(signed_area(loop_polygon(loop.curves)));
      CHECK(areas[0] == Approx(0.64));
      CHECK(areas[1] == Approx(-0.36));
      CHECK(areas[2] == Approx(0.04));
      CHECK(area_of(model) == Approx(0.32));
    }
  }
}

TEST_CASE("subfigures: scale, nesting, and cycles") {
  const std::string kSquare =
      "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,1.,1.,0.,0.,1.,0.,1.";
  const std::vector<IgesEntity> entities{{128, kSquare, 0, 0, kPart},
                                         {308, "0,4Htile,1,1", 0, 0, "00000200"},
                                         {408, "3,1.,2.,3.,2.", 0, 0, kPart},
                                         {308, "1,4Hpair,2,5,1", 0, 0, "00000200"},
                                         {408, "7,10.,0.,0.,0.5"}};
  const Model model = read(entities);
  REQUIRE(model.surfaces.size() == 2);
  CHECK(area_of(model) == Approx(1.0 + 0.25));
  CHECK((evaluate(model.surfaces[0].nurbs, 0.0, 0.0) - Vector3(10.5, 1.0, 1.5)).norm() < 1e-12);
  CHECK(error_of(iges_text({{308, "0,4Htile,1,3", 0, 0, "00000200"},
                            {408, "1,0.,0.,0.,1.", 0, 0, kPart},
                            {408, "1,0.,0.,0.,1."}}))
            .find("points back to it") != std::string::npos);
}

TEST_CASE("offset surfaces and curves keep their distance") {
  // A quarter of a cylinder of radius 2 about z, by 120 from its arc's start: moved outwards and inwards.
  for (const double distance : {0.5, -0.5}) {
    const std::vector<IgesEntity> entities{{110, "0.,0.,0.,0.,0.,1.", 0, 0, kPart},
                                           {110, "2.,0.,0.,2.,0.,3.", 0, 0, kPart},
                                           {120, "1,3,0.,1.5707963267948966", 0, 0, kPart},
                                           {140, "1.,1.,0.," + reals({distance}) + ",5"}};
    const Model model = read(entities);
    REQUIRE(model.surfaces.size() == 1);
    const NurbsSurface& s = model.surfaces[0].nurbs;
    for (int i = 0; i <= 20; ++i) {
      for (int k = 0; k <= 20; ++k) {
        const Vector3 p = evaluate(s, s.first_u() + (s.last_u() - s.first_u()) * i / 20.0,
                                   s.first_v() + (s.last_v() - s.first_v()) * k / 20.0);
        CHECK(std::abs(p.head<2>().norm() - (2.0 + distance)) < 4e-5);
      }
    }
  }
  const NurbsCurve curve = read_curve({{100, "0.,0.,0.,2.,0.,0.,2.", 0, 0, kPart},
                                       {130, "1,1,0,0,0,0.5,0.,0.,0.,0.,0.,1.,0.,1.5707963", 0, 0, kPart}},
                                      1);
  for (int i = 0; i <= 20; ++i) {
    const Vector3 p = evaluate(
        curve, curve.first_parameter() + (curve.last_parameter() - curve.first_parameter()) * i / 20);
    CHECK(std::abs(p.norm() - 1.5) < 4e-5);  // V x T points inwards on a counter-clockwise arc about V
  }
}

TEST_CASE("area integrals: closed forms, with and without loops") {
  const std::vector<IgesEntity> torus{
      {116, kPoint, 0, 0, kPart}, {123, kUp, 0, 0, kPart}, {198, "1,3,10.,3."}};
  const Model model = read(torus);
  const SurfaceIntegrals integrals = surface_integrals(model.surfaces.at(0));
  CHECK(integrals.area == Approx(4.0 * M_PI * M_PI * 30.0).epsilon(1e-7));
  CHECK(integrals.flux == Approx(2.0 * M_PI * M_PI * 10.0 * 9.0).epsilon(1e-7));  // outward normals
  CHECK(integrals.vector_area.norm() < 1e-6 * integrals.area);
}
