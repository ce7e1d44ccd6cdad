// Every corpus model made of the dissertation's entities slices, and the areas of its layers add up to its
// volume.

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/import/read_model.h"
#include "engine/model_bounds.h"
#include "engine/slicer.h"
#include "engine/slicing_planes.h"
#include "gcode/region/layer_region.h"
#include "tests/support/corpus.h"
#include "tests/support/manifest.h"

namespace {

using namespace lamina;

constexpr double kLambda = 0.2;
constexpr double kEpsilon = 0.05;

/// The volume column of the corpus manifest, mm^3, by file; files whose boundary does not close have none.
std::map<std::string, double> manifest_volumes() {
  std::map<std::string, double> volumes;
  constexpr std::size_t kFile = 1;
  constexpr std::size_t kVolume = 8;
  for (const tests::ManifestRow& cells : tests::manifest_rows({".ig"})) {
    if (cells[kVolume] != "-") volumes[cells[kFile]] = std::stod(cells[kVolume]);
  }
  return volumes;
}

struct SlicedVolume {
  double volume = 0.0;            ///< section areas times lambda, mm^3
  double half_cell_volume = 0.0;  ///< what half a cell along the perimeter amounts to, mm^3
  std::size_t layers = 0;
  std::size_t layers_with_area = 0;
};

SlicedVolume slice_to_volume(const std::string& file) {
  const engine::Model model = engine::read_model(tests::corpus_file(file)).model;
  const engine::Box3 bounds = engine::model_bounds(model);
  engine::SliceOptions options;
  options.epsilon = kEpsilon;
  engine::Slicer slicer(model,
                        engine::make_slicing_planes(bounds.min().z(), bounds.max().z(),
                                                    {kLambda, 0.0, engine::SlicePosition::kMiddle}),
                        options);
  SlicedVolume sliced;
  while (const auto layer = slicer.next()) {
    const gcode::LayerRegion region = gcode::make_region(*layer, {});
    double outline = 0.0;
    for (const engine::Polygon& polygon : region.region) {
      outline += engine::perimeter(polygon.outer);
      for (const engine::Loop& hole : polygon.holes) outline += engine::perimeter(hole);
    }
    const double area = engine::area(region.region);
    sliced.volume += area * kLambda;
    sliced.half_cell_volume += 0.5 * kEpsilon * outline * kLambda;
    ++sliced.layers;
    if (area > 0.0) ++sliced.layers_with_area;
  }
  return sliced;
}

/// Files that consist of entities of table 6.1.
const std::vector<std::string> kTable61Files{"analytic/box.igs",
                                             "analytic/box_hole.igs",
                                             "analytic/box_hole_lying.igs",
                                             "analytic/box_mixed_normals.igs",
                                             "analytic/box_open_side.igs",
                                             "analytic/cone_upright.igs",
                                             "analytic/cylinder_lying.igs",
                                             "analytic/cylinder_upright.igs",
                                             "analytic/frustum_down.igs",
                                             "analytic/sphere_cavity.igs",
                                             "analytic/sphere_r10.igs",
                                             "analytic/spheres_overlap.igs",
                                             "analytic/stacked_boxes.igs",
                                             "analytic/stacked_equal.igs",
                                             "analytic/torus_flat.igs",
                                             "analytic/torus_standing.igs",
                                             "analytic/tube_annulus.igs",
                                             "entities/lex_crlf_nonl.igs",
                                             "entities/lex_delims.igs",
                                             "entities/lex_dexp.igs",
                                             "entities/lex_hollerith.igs",
                                             "entities/mix_112_120.igs",
                                             "entities/mix_114_128.igs",
                                             "entities/mix_124_inch.igs",
                                             "freeform/teacup26.igs",
                                             "freeform/teapot28.igs",
                                             "freeform/teapot32_bottom.igs",
                                             "seed/bust600_clean.igs",
                                             "seed/bust601_gaps.igs",
                                             "seed/initials_WEO.igs",
                                             "seed/skullmask1260.igs",
                                             "seed/torus.igs",
                                             "seed/trefoil_swept.igs",
                                             "seed/vertebra504.igs"};

/// Two spheres of radius 8 whose centres are 8 apart: the manifest gives their plain sum, the union has the
/// lens once.
double union_of_spheres(double plain_sum) {
  constexpr double kRadius = 8.0;
  constexpr double kDistance = 8.0;
  const double lens =
      std::numbers::pi * (4.0 * kRadius + kDistance) * std::pow(2.0 * kRadius - kDistance, 2) / 12.0;
  return plain_sum - lens;
}

}  // namespace

TEST_CASE("section areas of the corpus add up to the volume of the model", "[corpus]") {
  if (!tests::corpus_present()) {
    WARN("the model corpus is not there: skipped");
    return;
  }
  const std::map<std::string, double> volumes = manifest_volumes();
  REQUIRE(volumes.size() > 20);
  std::size_t compared = 0;
  for (const std::string& file : kTable61Files) {
    INFO(file);
    const SlicedVolume sliced = slice_to_volume(file);
    CHECK(sliced.layers > 0);
    // A box without one wall has open contours only: there is nothing to fill.
    const bool bounds_area = file != "analytic/box_open_side.igs";
    CHECK((sliced.layers_with_area > 0) == bounds_area);
    const auto volume = volumes.find(file);
    if (volume == volumes.end()) continue;
    ++compared;
    const double expected =
        file == "analytic/spheres_overlap.igs" ? union_of_spheres(volume->second) : volume->second;
    INFO("sliced " << sliced.volume << " mm^3, expected " << expected << ", half a cell "
                   << sliced.half_cell_volume);
    CHECK(std::abs(sliced.volume - expected) <= sliced.half_cell_volume);
  }
  CHECK(compared >= 29);
}

TEST_CASE("a machined part has the same closed sections out of STEP and out of IGES", "[corpus]") {
  if (!tests::corpus_present()) {
    WARN("the model corpus is not there: skipped");
    return;
  }
  const engine::Model step = engine::read_model(tests::corpus_file("parts/part_bracket_ap203.stp")).model;
  const engine::Model iges = engine::read_model(tests::corpus_file("parts/part_bracket_186.igs")).model;
  std::vector<engine::SlicePlane> planes;
  for (double z = 0.13; z < 30.0; z += 0.31) planes.push_back({z, z, z});
  engine::Slicer from_step(step, planes, {});
  engine::Slicer from_iges(iges, planes, {});
  while (const auto expected = from_iges.next()) {
    const auto layer = from_step.next();
    REQUIRE(layer);
    CAPTURE(layer->plane.z);
    CHECK(layer->open.empty());
    CHECK(expected->open.empty());
    CHECK(layer->closed.size() == expected->closed.size());
    const double area = engine::area(gcode::make_region(*expected, {}).region);
    CHECK(engine::area(gcode::make_region(*layer, {}).region) == Approx(area).epsilon(1e-4));
  }
}

TEST_CASE("planes through the level edges and holes of a machined part", "[corpus]") {
  if (!tests::corpus_present()) {
    WARN("the model corpus is not there: skipped");
    return;
  }
  for (const std::string file : {"part_bracket_144.igs", "part_bracket_186.igs", "part_bracket_nurbs_144.igs",
                                 "part_bracket_ap203.stp", "part_bracket_inch_144.igs"}) {
    CAPTURE(file);
    const engine::Model model = engine::read_model(tests::corpus_file("parts/" + file)).model;
    engine::Slicer slicer(model, {{6.0, 6.0, 6.0}, {15.0, 15.0, 15.0}}, {});
    // The top of the plate: 40 x 24 mm, one corner a ball of radius 5 that touches the plane, a hole of
    // radius 4.
    const auto plate = slicer.next();
    REQUIRE(plate);
    CHECK(plate->open.empty());
    const double expected = 40.0 * 24.0 - 6.25 * std::numbers::pi - 16.0 * std::numbers::pi;
    CHECK(engine::area(gcode::make_region(*plate, {}).region) == Approx(expected).epsilon(1e-5));
    // The highest line of the hole across the wall, 3 mm long up to the countersink, touches the plane.
    const auto wall = slicer.next();
    REQUIRE(wall);
    REQUIRE(wall->open.size() == 1);
    CHECK(wall->open.front().touch);
    CHECK(engine::length(wall->open.front().curve) == Approx(3.0).epsilon(1e-3));
  }
}
