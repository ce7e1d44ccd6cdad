#include "tests/reference/reference_slicer.h"

#include <limits>
#include <string>

#include <catch2/catch.hpp>

#include "engine/slicing_planes.h"
#include "tests/support/analytic_models.h"

namespace lamina::tests {
namespace {

using engine::SlicePlane;
using reference::Layer;
using reference::ReferenceSlicer;
using reference::SliceError;
using reference::SliceOptions;

std::vector<SlicePlane> planes_at(const std::vector<double>& heights) {
  std::vector<SlicePlane> planes;
  planes.reserve(heights.size());
  for (const double z : heights) planes.push_back({z, z, z});
  return planes;
}

/// The message of the error that these options or planes cause; empty if none.
std::string refusal(const SliceOptions& options, const std::vector<double>& heights = {1.0}) {
  try {
    ReferenceSlicer slicer(box({0, 0, 0}, {5, 4, 3}).model, planes_at(heights), options);
    while (slicer.next()) {
    }
  } catch (const SliceError& error) {
    return error.what();
  }
  return {};
}

SliceOptions changed(void (*change)(SliceOptions&)) {
  SliceOptions options;
  change(options);
  return options;
}

}  // namespace

TEST_CASE("layers come in the order of their planes, then none", "[slicer]") {
  const std::vector<double> heights{0.5, 1.0, 1.0, 2.5};
  ReferenceSlicer slicer(box({0, 0, 0}, {5, 4, 3}).model, planes_at(heights), {});
  CHECK(slicer.layer_count() == 4);
  CHECK(slicer.patch_count() > 0);
  for (std::size_t k = 0; k < heights.size(); ++k) {
    const auto layer = slicer.next();
    REQUIRE(layer);
    CHECK(layer->index == k);
    CHECK(layer->plane.z == heights[k]);
    CHECK(layer->closed.size() == 1);
  }
  CHECK_FALSE(slicer.next());
  CHECK_FALSE(slicer.next());
}

TEST_CASE("planes beside the model give empty layers", "[slicer]") {
  ReferenceSlicer slicer(box({0, 0, 0}, {5, 4, 3}).model, planes_at({-10.0, -1.0, 1.5, 4.0, 100.0}), {});
  for (const std::size_t contours : {0U, 0U, 1U, 0U, 0U}) {
    const auto layer = slicer.next();
    REQUIRE(layer);
    CHECK(layer->closed.size() == contours);
    CHECK(layer->open.empty());
    CHECK(layer->planar.empty());
    CHECK(layer->points.empty());
  }
}

TEST_CASE("an empty model gives empty layers", "[slicer]") {
  ReferenceSlicer slicer({}, planes_at({0.0, 1.0}), {});
  for (int k = 0; k < 2; ++k) {
    const auto layer = slicer.next();
    REQUIRE(layer);
    CHECK(layer->closed.empty());
  }
  CHECK_FALSE(slicer.next());
}

TEST_CASE("a layer is the same whatever planes came before it", "[slicer]") {
  const engine::Model model = flat_torus({0, 0, 0}, 4.0, 1.5).model;
  ReferenceSlicer alone(model, planes_at({0.7}), {});
  ReferenceSlicer after_others(model, planes_at({-1.4, -0.3, 0.1, 0.69, 0.7}), {});
  const Layer expected = *alone.next();
  for (int k = 0; k < 4; ++k) after_others.next();
  const Layer layer = *after_others.next();
  REQUIRE(layer.closed.size() == expected.closed.size());
  for (std::size_t k = 0; k < layer.closed.size(); ++k) {
    CHECK(layer.closed[k].curve.control_points == expected.closed[k].curve.control_points);
    CHECK(layer.closed[k].curve.knots == expected.closed[k].curve.knots);
  }
}

TEST_CASE("the report counts what was there", "[slicer]") {
  ReferenceSlicer slicer(box({0, 0, 0}, {5, 4, 3}).model, planes_at({1.0, 1.0}), {});
  const Layer first = *slicer.next();
  CHECK(first.report.components == 1);
  CHECK(first.report.patches_added == first.report.active_patches);
  CHECK(first.report.patches_removed == 0);
  CHECK(first.report.points_near_plane <= first.report.points_held);
  CHECK(first.report.boundary_cells <= first.report.strong_cells);
  CHECK(first.report.strong_cells <= first.report.grid_cells);
  CHECK(first.report.control_points == first.closed.front().curve.control_points.size());
  // 5 x 4 mm in 101 x 81 cells of 0.05 mm: each edge is moved out by the model tolerance.
  CHECK(first.report.grid_cells == 8181);
  const Layer second = *slicer.next();
  CHECK(second.report.patches_added == 0);
  CHECK(second.report.active_patches == first.report.active_patches);
}

TEST_CASE("no points are held above the model", "[slicer]") {
  ReferenceSlicer slicer(sphere({0, 0, 0}, 2.0).model, planes_at({0.0, 3.0}), {});
  CHECK(slicer.next()->report.points_held > 0);
  const Layer above = *slicer.next();
  CHECK(above.report.points_held == 0);
  CHECK(above.report.patches_removed > 0);
}

TEST_CASE("options out of range are refused by name and value", "[slicer]") {
  CHECK(refusal({}).empty());
  CHECK_THAT(refusal(changed([](SliceOptions& o) { o.layer_thickness = 0.0; })),
             Catch::Contains("layer thickness is 0"));
  CHECK_THAT(refusal(changed([](SliceOptions& o) { o.layer_thickness = -0.2; })),
             Catch::Contains("layer thickness is -0.2"));
  CHECK_THAT(refusal(changed([](SliceOptions& o) { o.epsilon = 0.0; })), Catch::Contains("tolerance is 0"));
  CHECK_THAT(refusal(changed([](SliceOptions& o) { o.epsilon = 1e-6; })),
             Catch::Contains("tolerance is 1e-06"));
  CHECK_THAT(refusal(changed([](SliceOptions& o) { o.epsilon = std::numeric_limits<double>::quiet_NaN(); })),
             Catch::Contains("tolerance is nan"));
  CHECK_THAT(refusal(changed([](SliceOptions& o) { o.degree = 0; })), Catch::Contains("degree is 0"));
  CHECK_THAT(refusal(changed([](SliceOptions& o) { o.degree = 10; })), Catch::Contains("degree is 10"));
  CHECK_THAT(refusal(changed([](SliceOptions& o) { o.band_constant = 1; })),
             Catch::Contains("band constant is 1"));
  CHECK_THAT(refusal(changed([](SliceOptions& o) { o.oversampling = 0.5; })),
             Catch::Contains("over-sampling is 0.5"));
  CHECK_THAT(refusal(changed([](SliceOptions& o) { o.oversampling = 11.0; })),
             Catch::Contains("over-sampling is 11"));
}

TEST_CASE("planes that fall are refused", "[slicer]") {
  CHECK_THAT(refusal({}, {1.0, 2.0, 1.5}), Catch::Contains("plane 2 at z = 1.5"));
  CHECK(refusal({}, {1.0, 1.0}).empty());
}

TEST_CASE("a grid beyond the limit is refused with a tolerance that fits", "[slicer]") {
  SliceOptions options;
  options.most_cells = 1000.0;
  const std::string message = refusal(options);
  CHECK_THAT(message, Catch::Contains("5 x 4 mm"));
  CHECK_THAT(message, Catch::Contains("the limit is 1e+03"));
  // 20 mm^2 in 1000 cells: sqrt(0.02) = 0.141 mm, and one per cent.
  CHECK_THAT(message, Catch::Contains("0.14 mm"));
}

}  // namespace lamina::tests
