// At the very heights where surfaces of CAD models begin, end or are touched by the plane, a layer is one of
// those just below and just above, or both together.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/import/read_model.h"
#include "engine/model_bounds.h"
#include "engine/slicer.h"
#include "gcode/region/layer_region.h"
#include "tests/support/corpus.h"

namespace lamina::tests {
namespace {

constexpr double kDrawn = 1e-4;  // mm

/// Closed solids with level faces, round holes along every axis and faces that touch.
const std::vector<std::string> kFiles{"analytic/box_hole_lying.igs",  "analytic/cylinder_lying.igs",
                                      "analytic/stacked_boxes.igs",   "analytic/stacked_equal.igs",
                                      "analytic/torus_standing.igs",  "entities/offset140_tube.igs",
                                      "parts/part_bracket_144.igs",   "parts/part_bracket_186.igs",
                                      "parts/part_bracket_ap203.stp", "real/1210_SMD.stp",
                                      "real/EPL22_6_16.stp",          "real/RLF_12545.igs",
                                      "real/as1-tu-203.stp",          "real/screw.step",
                                      "real_fetched/input.igs",       "real_fetched/io1-ug-214.stp"};

/// Lower and upper ends of the surfaces strictly inside the model, ascending.
std::vector<double> level_heights(const engine::Model& model) {
  const engine::Box3 box = engine::model_bounds(model);
  const double margin = 1e-3 * box.sizes().z();
  std::vector<double> heights;
  for (const engine::Surface& surface : model.surfaces) {
    engine::Model alone;
    alone.surfaces = {surface};
    const engine::Box3 bounds = engine::model_bounds(alone);
    for (const double end : {bounds.min().z(), bounds.max().z()}) {
      // Bounds are a micrometre off; the ends of drawn parts are not.
      const double z = std::round(end / kDrawn) * kDrawn;
      if (z > box.min().z() + margin && z < box.max().z() - margin) heights.push_back(z);
    }
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(
      std::unique(heights.begin(), heights.end(), [&](double a, double b) { return b - a < margin; }),
      heights.end());
  return heights;
}

struct Cut {
  double area = 0.0;
  bool open = false;
};

TEST_CASE("layers at level faces and touching holes are those beside them", "[corpus]") {
  if (!corpus_present()) {
    WARN("the model corpus is not there: skipped");
    return;
  }
  std::size_t levels = 0;
  for (const std::string& file : kFiles) {
    const engine::Model model = engine::read_model(corpus_file(file)).model;
    const std::vector<double> heights = level_heights(model);
    const double beside = 2e-5 * engine::model_bounds(model).sizes().z();
    std::vector<engine::SlicePlane> planes;
    for (const double height : heights) {
      for (const double z : {height - beside, height, height + beside}) planes.push_back({z, z, z});
    }
    engine::Slicer slicer(model, planes, {});
    std::vector<Cut> cuts;
    while (const auto layer = slicer.next()) {
      const bool open = std::any_of(layer->open.begin(), layer->open.end(),
                                    [](const engine::OpenContour& contour) { return !contour.touch; });
      cuts.push_back({engine::area(gcode::make_region(*layer, {0.001}).region), open});
    }
    for (std::size_t k = 0; k < heights.size(); ++k) {
      const Cut& below = cuts[3 * k];
      const Cut& at = cuts[3 * k + 1];
      const Cut& above = cuts[3 * k + 2];
      CAPTURE(file, heights[k], below.area, at.area, above.area);
      // Beside a touch areas change with the root of the distance.
      const double margin = 5e-3 * std::max(below.area, above.area);
      CHECK(at.area >= std::min(below.area, above.area) - margin);
      CHECK(at.area <= below.area + above.area + margin);
      CHECK((!at.open || below.open || above.open));
      ++levels;
    }
  }
  CHECK(levels > 60);
}

}  // namespace
}  // namespace lamina::tests
