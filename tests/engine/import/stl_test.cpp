#include <chrono>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "engine/import/import_error.h"
#include "engine/import/read_model.h"
#include "engine/import/stl/read_stl.h"
#include "engine/model_bounds.h"
#include "tests/engine/import/mesh_shapes.h"
#include "tests/engine/import/peak_memory.h"
#include "tests/support/corpus.h"

using namespace lamina::engine;
using namespace lamina::tests;

namespace {

std::string text_facet(const std::string& corners) {
  return "facet normal 0 0 0\nouter loop\n" + corners + "endloop\nendfacet\n";
}

std::string text_stl(const std::vector<Corners>& facets) {
  std::string text = "solid corner of a cube\n";
  for (const Corners& facet : facets) {
    std::string corners;
    for (const auto& p : facet) {
      corners +=
          "vertex " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n";
    }
    text += text_facet(corners);
  }
  return text + "endsolid corner of a cube\n";
}

std::string error_reading(const std::string& bytes) {
  try {
    read_stl(bytes, "part.stl");
  } catch (const ImportError& error) {
    return error.what();
  }
  return {};
}

void check_tetrahedron(const ImportResult& result) {
  REQUIRE(result.model.meshes.size() == 1);
  CHECK(result.model.meshes[0].vertices.size() == 4);
  CHECK(result.model.meshes[0].facets.size() == 4);
  CHECK(six_volumes(result.model.meshes[0]) == Approx(1.0));
}

/// A sphere of radius 10 as a grid of `rings` x `sectors` quadrilaterals, two facets each.
std::vector<Corners> sphere(int rings, int sectors) {
  const auto point = [&](int i, int j) -> std::array<float, 3> {
    if (i == 0 || i == rings) return {0.0F, 0.0F, i == 0 ? -10.0F : 10.0F};
    const double latitude = M_PI * i / rings;
    const double longitude = 2.0 * M_PI * (j % sectors) / sectors;
    return {static_cast<float>(10.0 * std::sin(latitude) * std::cos(longitude)),
            static_cast<float>(10.0 * std::sin(latitude) * std::sin(longitude)),
            static_cast<float>(-10.0 * std::cos(latitude))};
  };
  std::vector<Corners> facets;
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sectors; ++j) {
      if (i > 0) facets.push_back({point(i, j), point(i, j + 1), point(i + 1, j)});
      if (i + 1 < rings) facets.push_back({point(i, j + 1), point(i + 1, j + 1), point(i + 1, j)});
    }
  }
  return facets;
}

}  // namespace

TEST_CASE("STL: both forms give the same triangles, corners welded") {
  const ImportResult binary = read_stl(binary_stl(tetrahedron()), "part.stl");
  check_tetrahedron(binary);
  CHECK(binary.report.format == "STL (binary)");
  const ImportResult text = read_stl(text_stl(tetrahedron()), "part.stl");
  check_tetrahedron(text);
  CHECK(text.report.format == "STL (text)");
  CHECK(text.report.tolerated.empty());
  CHECK(binary.model.meshes[0].facets == text.model.meshes[0].facets);
}

TEST_CASE("STL: content tells the forms apart, not the word solid") {
  check_tetrahedron(read_stl(binary_stl(tetrahedron(), "solid facet normal"), "part.stl"));
  check_tetrahedron(read_stl(binary_stl(tetrahedron(), "solid x\nfacet normal 0 0 0\n"), "part.stl"));
  CHECK(looks_like_stl(binary_stl(tetrahedron(), "solid")));
  CHECK(looks_like_stl(text_stl(tetrahedron())));
  CHECK(looks_like_stl("  solid\n\n  facet normal"));
  CHECK_FALSE(looks_like_stl("solid ground is what we need\nfor a house"));
  CHECK_FALSE(looks_like_stl(""));
}

TEST_CASE("STL text: case, line ends, normals left out, several solids, polygons, no end") {
  const std::string x = "vertex 0 0 0\r\nVERTEX +1e0 0 0\r\nvertex 0 1.0E+00 -0\r\n";
  const ImportResult result =
      read_stl("SOLID\r\nFACET\r\nOUTER LOOP\r\n" + x + "ENDLOOP\r\nENDFACET\r\nendsolid\r\nsolid b\r\n" +
                   text_facet(x + "vertex -1 0 0\n"),
               "part.stl");
  CHECK(result.model.meshes[0].facets.size() == 3);
  CHECK(result.model.meshes[0].vertices.size() == 4);
  REQUIRE(result.report.tolerated.size() == 2);
  CHECK(result.report.tolerated[0].what.find("more than three corners") != std::string::npos);
  CHECK(result.report.tolerated[1].what.find("endsolid missing") != std::string::npos);
}

TEST_CASE("STL: what is not trusted and what is refused") {
  using Catch::Contains;
  const std::string good = binary_stl(tetrahedron());
  CHECK_THAT(error_reading(good.substr(0, good.size() - 60)),
             Contains("announces 4 facets, and there are 2"));
  CHECK_THAT(error_reading(binary_stl(tetrahedron(), "x", 0xfffffff0)), Contains("cut short"));
  CHECK_THAT(error_reading("solid"), Contains("is no STL file"));
  CHECK_THAT(error_reading(text_stl({})), Contains("no usable facet"));
  CHECK_THAT(error_reading(binary_stl({})), Contains("no usable facet"));
  CHECK_THAT(error_reading(text_stl(tetrahedron()).substr(0, text_stl(tetrahedron()).rfind("vertex"))),
             Contains("cut short inside a facet"));
  CHECK_THAT(error_reading("solid\n" + text_facet("vertex 0 0 zero\n")),
             Contains("part.stl: file line 4: \"zero\" is not a number"));
  CHECK_THAT(error_reading("solid\nfacet\nouter loop\nendloop\nendfacet\n"), Contains("has 0 corners"));
  check_tetrahedron(read_stl(good + "trailing", "part.stl"));
  check_tetrahedron(read_stl(binary_stl(tetrahedron(), "x", 0), "part.stl"));
  check_tetrahedron(read_stl(binary_stl(tetrahedron(), "x", 0xffffffff), "part.stl"));

  std::vector<Corners> facets = tetrahedron();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  for (const float bad : {nan, infinite, -infinite, 1e10F}) {
    std::vector<Corners> more = facets;
    more.push_back({{{0, 0, 0}, {1, bad, 0}, {0, 1, 0}}});
    const ImportResult result = read_stl(binary_stl(more), "part.stl");
    check_tetrahedron(result);
    REQUIRE(result.report.tolerated.size() == 1);
    CHECK(result.report.tolerated[0].line == 5);
  }
  check_tetrahedron(read_stl(
      text_stl(tetrahedron()) + "solid\n" + text_facet("vertex nan 0 0\nvertex 1 1 1\nvertex 2 1 0\n"),
      "part.stl"));
}

TEST_CASE("STL: corners are one vertex only where they are equal, negative zero and zero among them") {
  const float one = 1.0F;
  const float next = std::nextafter(one, 2.0F);
  const auto mesh =
      read_stl(
          binary_stl({{{{0, 0, 0}, {one, 0, 0}, {0, 1, 0}}}, {{{-0.0F, 0, -0.0F}, {next, 0, 0}, {0, 1, 0}}}}),
          "part.stl")
          .model.meshes[0];
  CHECK(mesh.vertices.size() == 4);
  CHECK(mesh.facets[0][0] == mesh.facets[1][0]);
  CHECK(mesh.facets[0][1] != mesh.facets[1][1]);
}

TEST_CASE("STL: memory while reading stays below the size of the file again") {
  const std::string bytes = binary_stl(sphere(200, 500));
  const std::size_t before = start_peak_memory();
  const ImportResult result = read_stl(bytes, "sphere.stl");
  const std::size_t peak = peak_memory() - before;
  INFO("peak " << peak << " bytes on a file of " << bytes.size());
  CHECK(peak < bytes.size());
  CHECK(result.model.meshes[0].vertices.size() == 199 * 500 + 2);
  CHECK(six_volumes(result.model.meshes[0]) / 6.0 == Approx(4.0 / 3.0 * M_PI * 1000.0).epsilon(1e-3));
}

TEST_CASE("STL: memory where no two corners are equal") {
  std::vector<Corners> facets;
  for (int i = 0; i < 100000; ++i) {
    const auto x = static_cast<float>(i);
    facets.push_back({{{x, 0, 0}, {x, 1, 0}, {x, 0, 1}}});
  }
  const std::string bytes = binary_stl(facets);
  const std::size_t before = start_peak_memory();
  CHECK(read_stl(bytes, "loose.stl").model.meshes[0].vertices.size() == 300000);
  CHECK(peak_memory() - before < 3 * bytes.size());
}

TEST_CASE("corpus: the meshes have the facets, boxes and volumes of the manifest") {
  if (!corpus_present()) {
    WARN("the model corpus is missing: skipped");
    return;
  }
  for (const auto& [file, facets, volume] : {std::tuple{"mesh/bracket_clean.stl", 1926U, 8702.2069},
                                             {"mesh/bracket_broken.stl", 1929U, 9298.542}}) {
    INFO(file);
    const Model model = read_model(corpus_file(file)).model;
    REQUIRE(model.meshes.size() == 1);
    CHECK(model.meshes[0].facets.size() == facets);
    const Box3 box = model_bounds(model);
    CHECK((box.min() - Vector3(0, 0, 0)).norm() < 1e-3);
    CHECK((box.max() - Vector3(40, 24, 30)).norm() < 1e-3);
    if (facets == 1926U) CHECK(six_volumes(model.meshes[0]) / 6.0 == Approx(volume).epsilon(1e-5));
  }
}
