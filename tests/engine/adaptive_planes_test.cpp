#include "engine/adaptive_planes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "tests/support/analytic_models.h"

namespace lamina::tests {
namespace {

using engine::AdaptivePlanes;
using engine::SlicePlane;
using engine::SlicingPlanesOptions;

SlicingPlanesOptions adaptive_options(double cusp_height) {
  SlicingPlanesOptions options;
  options.adaptive = {true, 0.05, 0.4, cusp_height, 1.4};
  return options;
}

AdaptivePlanes planes_of(const engine::Model& model, double bottom, double top,
                         const SlicingPlanesOptions& options) {
  return engine::make_adaptive_planes(
      engine::measure_slopes(model, bottom, top, 0.25 * options.adaptive.least_thickness), top, options);
}

/// What holds for layers of any model.
void check_stack(const AdaptivePlanes& layers, double bottom, double top,
                 const SlicingPlanesOptions& options) {
  const auto& planes = layers.planes;
  REQUIRE(!planes.empty());
  CHECK(planes.front().bottom == bottom);
  CHECK(planes.back().top == top);
  CHECK(layers.uneven_pairs == 0);
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const double thickness = planes[k].thickness();
    CHECK(thickness <= options.adaptive.greatest_thickness + 1e-9);
    CHECK(planes[k].z == Approx(0.5 * (planes[k].bottom + planes[k].top)));
    if (k == 0) continue;
    CHECK(planes[k].bottom == planes[k - 1].top);
    const double before = planes[k - 1].thickness();
    CHECK(std::max(thickness, before) <=
          options.adaptive.greatest_ratio * std::min(thickness, before) + 1e-8);
  }
}

TEST_CASE("a sphere's slope profile is its closed form", "[adaptive]") {
  const AnalyticModel solid = sphere({0, 0, 5}, 5.0);
  const double bin = 0.05;
  const engine::SlopeProfile profile = engine::measure_slopes(solid.model, 0.0, 10.0, bin);
  REQUIRE(profile.normal_z.size() == 200);
  CHECK(profile.level.empty());
  for (std::size_t k = 0; k < profile.normal_z.size(); ++k) {
    const double low = std::abs(bin * static_cast<double>(k) - 5.0);
    const double high = std::abs(bin * static_cast<double>(k + 1) - 5.0);
    const double exact = std::max(low, high) / 5.0;
    CHECK(profile.normal_z[k] >= exact - 0.01);
    CHECK(profile.normal_z[k] <= exact + 0.04);
  }
}

TEST_CASE("layers of a sphere: cusps under the bound, as thick as it allows", "[adaptive]") {
  const double radius = 10.0;
  const AnalyticModel solid = sphere({0, 0, radius}, radius);
  for (const double cusp : {0.02, 0.1, 0.2}) {
    const SlicingPlanesOptions options = adaptive_options(cusp);
    const AdaptivePlanes layers = planes_of(solid.model, 0.0, 2.0 * radius, options);
    CAPTURE(cusp, layers.planes.size());
    check_stack(layers, 0.0, 2.0 * radius, options);
    CHECK(layers.thin_layers == 0);
    double thickest_allowed = 0.0;
    for (const SlicePlane& plane : layers.planes) {
      const double normal_z =
          std::max(std::abs(plane.bottom - radius), std::abs(plane.top - radius)) / radius;
      // Where a layer more would be too thin, the thinnest ones are thickened a little.
      if (plane.thickness() > 1.02 * options.adaptive.least_thickness)
        CHECK(plane.thickness() * normal_z <= 1.02 * cusp);
      thickest_allowed = std::max(thickest_allowed, plane.thickness());
    }
    CHECK(thickest_allowed > 0.9 * options.adaptive.greatest_thickness);
    // The least number of layers: the integral of 1 / allowed thickness.
    double least = 0.0;
    for (double z = 0.0; z < 2.0 * radius; z += 1e-3) {
      const double normal_z = std::max(std::abs(z - radius) / radius, 1e-9);
      least += 1e-3 / std::clamp(cusp / normal_z, options.adaptive.least_thickness,
                                 options.adaptive.greatest_thickness);
    }
    CHECK(static_cast<double>(layers.planes.size()) < 1.25 * least + 4.0);
  }
}

TEST_CASE("upright walls get the thickest layers, and level faces lie between layers", "[adaptive]") {
  const SlicingPlanesOptions options = adaptive_options(0.05);
  const engine::Model steps =
      united("steps", {box({0, 0, 0}, {20, 20, 3.33}).model, box({5, 5, 3.33}, {15, 15, 7.77}).model});
  const AdaptivePlanes layers = planes_of(steps, 0.0, 7.77, options);
  check_stack(layers, 0.0, 7.77, options);
  CHECK(layers.missed_faces == 0);
  CHECK(layers.planes.size() == 9 + 12);  // 3.33 / 0.4 and 4.44 / 0.4, rounded up
  CHECK(std::any_of(layers.planes.begin(), layers.planes.end(),
                    [](const SlicePlane& plane) { return std::abs(plane.top - 3.33) < 1e-9; }));
}

TEST_CASE("level faces closer than the least thickness: the larger one is met, the other counted",
          "[adaptive]") {
  const SlicingPlanesOptions options = adaptive_options(0.05);
  const engine::Model steps =
      united("steps", {box({0, 0, 0}, {20, 20, 3.0}).model, box({5, 5, 3.0}, {6, 6, 3.02}).model,
                       box({10, 10, 3.0}, {15, 15, 7.0}).model});
  const AdaptivePlanes layers = planes_of(steps, 0.0, 7.0, options);
  check_stack(layers, 0.0, 7.0, options);
  CHECK(layers.missed_faces == 1);
  CHECK(std::any_of(layers.planes.begin(), layers.planes.end(),
                    [](const SlicePlane& plane) { return std::abs(plane.top - 3.0) < 1e-9; }));
}

TEST_CASE("the first layer is as thick as asked for", "[adaptive]") {
  SlicingPlanesOptions options = adaptive_options(0.1);
  options.first_layer_thickness = 0.3;
  const AdaptivePlanes layers = planes_of(cone({0, 0, 0}, 5.0, 8.0).model, 0.0, 8.0, options);
  CHECK(layers.planes.front().thickness() == Approx(0.3));
  // A cone leans alike at every height: normal z = r / sqrt(r^2 + h^2).
  const double normal_z = 5.0 / std::hypot(5.0, 8.0);
  for (std::size_t k = 1; k < layers.planes.size(); ++k)
    CHECK(layers.planes[k].thickness() == Approx(0.1 / normal_z).epsilon(0.02));
}

TEST_CASE("impossible options are refused", "[adaptive]") {
  const engine::SlopeProfile profile{0.0, 0.01, std::vector<double>(100, 0.5), {}};
  SlicingPlanesOptions options = adaptive_options(0.1);
  options.adaptive.greatest_thickness = 0.01;
  CHECK_THROWS_AS(engine::make_adaptive_planes(profile, 1.0, options), std::invalid_argument);
  options = adaptive_options(0.0);
  CHECK_THROWS_AS(engine::make_adaptive_planes(profile, 1.0, options), std::invalid_argument);
  options = adaptive_options(0.1);
  options.adaptive.greatest_ratio = 1.0;
  CHECK_THROWS_AS(engine::make_adaptive_planes(profile, 1.0, options), std::invalid_argument);
}

}  // namespace
}  // namespace lamina::tests
