// The numbers that ARCHITECTURE.md tells along the way of one model.

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/import/read_model.h"
#include "engine/model_bounds.h"
#include "engine/slicer.h"
#include "engine/slicing_planes.h"
#include "gcode/region/layer_region.h"
#include "tests/support/corpus.h"

using namespace lamina;

TEST_CASE("the vertebra's way through the house, with the numbers of ARCHITECTURE.md", "[story]") {
  const engine::ImportResult import = engine::read_model(tests::data_file("vertebra504.igs.gz"));
  CHECK(import.model.surfaces.size() == 504);

  const engine::Box3 bounds = engine::model_bounds(import.model);
  engine::Slicer slicer(import.model, engine::make_slicing_planes(bounds.min().z(), bounds.max().z(), {}),
                        {});
  CHECK(slicer.patch_count() == 85176);
  CHECK(slicer.layer_count() == 94);

  std::optional<engine::Layer> layer;
  while ((layer = slicer.next()) && layer->index < 50) {
  }
  REQUIRE(layer);
  CHECK(layer->plane.z == Approx(10.0995).margin(1e-4));
  CHECK(layer->report.active_patches == 1106);
  CHECK(layer->report.patches_added == 1100);
  CHECK(layer->report.cells == 1106);
  CHECK(layer->report.arcs == 1106);
  CHECK(layer->report.nodes == 3323);
  CHECK(layer->report.tiles == 46);
  CHECK(layer->report.components == 2);
  CHECK(layer->report.control_points == 200);
  CHECK(layer->closed.size() == 2);

  const gcode::LayerRegion region = gcode::make_region(*layer, {});
  REQUIRE(region.region.size() == 1);
  CHECK(region.region.front().holes.size() == 1);
  CHECK(engine::area(region.region) == Approx(328.05).margin(0.01));
}
