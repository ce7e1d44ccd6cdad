#include "engine/import/inspect/boundary_report.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/import/read_model.h"
#include "engine/import/stl/read_stl.h"
#include "tests/engine/import/mesh_shapes.h"
#include "tests/support/corpus.h"

using namespace lamina::engine;
using namespace lamina::tests;

TEST_CASE("boundary report: triangles, closed and with one missing") {
  std::vector<Corners> facets = tetrahedron();
  const BoundaryReport whole = boundary_report(read_stl(binary_stl(facets), "part").model);
  CHECK(whole.is_closed());
  CHECK(whole.edges == 6);
  CHECK(whole.volume.value() == Approx(1.0 / 6.0));
  CHECK(whole.area == Approx(1.5 + 0.5 * std::sqrt(3.0)));
  facets.pop_back();
  const BoundaryReport open = boundary_report(read_stl(binary_stl(facets), "part").model);
  CHECK(open.open_edges == 3);
  CHECK_FALSE(open.volume.has_value());
}

TEST_CASE("corpus: what closes, and its volume, whichever way its faces are turned") {
  if (!corpus_present()) {
    WARN("the model corpus is missing: skipped");
    return;
  }
  const std::vector<std::pair<std::string, double>> closed{
      {"analytic/box_mixed_normals.igs", 1728.0},      {"analytic/sphere_cavity.igs", 3284.017},
      {"analytic/tube_annulus.igs", 2412.7432},        {"entities/bounded143.igs", 769.69346},
      {"entities/trim144_pcurves.igs", 1078.9372},     {"entities/trim144_3donly.igs", 1078.9369},
      {"entities/offset140_tube.igs", 1555.0885},      {"entities/plane108_118.igs", 1080.0},
      {"parts/part_bracket_144.igs", 8699.2},          {"parts/part_bracket_186.igs", 8699.2},
      {"parts/part_bracket_nurbs_144.igs", 8699.2},    {"parts/part_loft_186.igs", 8396.633},
      {"real_fetched/input.igs", 122585.73},           {"real_fetched/test_pipe_hollow.iges", 1.1309734e10},
      {"entities/subfigure_308_408_scaled.igs", 270.0}};
  for (const auto& [file, volume] : closed) {
    INFO(file);
    const BoundaryReport report = boundary_report(read_model(corpus_file(file)).model);
    CHECK(report.is_closed());
    CHECK(report.volume.value_or(0.0) == Approx(volume).epsilon(2e-5));
    CHECK(report.largest_gap <= report.joined_within);
  }
  const BoundaryReport open = boundary_report(read_model(corpus_file("analytic/box_open_side.igs")).model);
  CHECK(open.open_edges == 4);
  // Solids that touch: more than two faces along an edge.
  CHECK_FALSE(
      boundary_report(read_model(corpus_file("analytic/stacked_equal.igs")).model).volume.has_value());
}
