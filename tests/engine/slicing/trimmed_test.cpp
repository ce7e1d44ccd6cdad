// Trimmed surfaces: the same sections as models without trim curves, and closed forms; ends of arcs on the
// trim curves; what lies in the plane.

#include <cmath>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "engine/model_bounds.h"
#include "engine/slicer.h"
#include "tests/engine/slicing/sliced_layers.h"
#include "tests/support/analytic_models.h"
#include "tests/support/contour_measure.h"
#include "tests/support/trimmed_models.h"
#include "tools/bench/contour_kinds.h"

namespace lamina::tests {
namespace {

using engine::Layer;
using engine::Model;
using engine::Vector2;
using engine::Vector3;

constexpr double kEpsilon = 0.02;

Layer layer_at(const Model& model, double z) {
  engine::SliceOptions options;
  options.epsilon = kEpsilon;
  return *engine::Slicer(model, {{z, z, z}}, options).next();
}

TEST_CASE("a box with a hole, trimmed out of planes and a cylinder", "[slicing][trim]") {
  const Vector3 low(1, 2, 3);
  const Vector3 high(21, 17, 13);
  const AnalyticModel plain = box_with_hole(low, high, 4.0);
  const Model trimmed = trimmed_box_with_hole(low, high, 4.0);
  for (const double z : {3.001, 5.0, 8.123, 12.999}) {
    const Layer layer = layer_at(trimmed, z);
    CAPTURE(z);
    REQUIRE(layer.closed.size() == 2);
    CHECK(layer.open.empty());
    CHECK(layer.planar.empty());
    const Section exact = plain.section(z);
    const auto loops = closed_loops(layer, 1e-4 * kEpsilon);
    CHECK(parity_area(loops) == Approx(exact.area).epsilon(1e-6));
    CHECK(greatest_distance_from(exact, loops) < 1e-5);
    CHECK(greatest_distance_to(exact, loops, 0.05) < 1e-5);
  }
}

TEST_CASE("its faces in the plane are the rectangle with the hole", "[slicing][trim]") {
  const Model trimmed = trimmed_box_with_hole({0, 0, 0}, {20, 15, 10}, 4.0);
  for (const double z : {0.0, 10.0}) {
    const Layer layer = layer_at(trimmed, z);
    CAPTURE(z);
    REQUIRE(layer.planar.size() == 1);
    REQUIRE(layer.planar.front().inner.size() == 1);
    CHECK(layer.open.empty());
    CHECK(std::abs(engine::signed_area(layer.planar.front().outer)) == Approx(300.0).epsilon(1e-9));
    CHECK(std::abs(engine::signed_area(layer.planar.front().inner.front())) ==
          Approx(16.0 * std::numbers::pi).epsilon(1e-4));
  }
}

TEST_CASE("posed at random: trimmed and untrimmed have the same sections", "[slicing][trim]") {
  constexpr unsigned kSeed = 11;
  INFO("seed " << kSeed);
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const Model plain = box_with_hole({-10, -7, -5}, {10, 7, 5}, 3.0).model;
  const Model trimmed = trimmed_box_with_hole({-10, -7, -5}, {10, 7, 5}, 3.0);
  for (int k = 0; k < 20; ++k) {
    const Vector3 axis = Vector3(number(random), number(random), number(random)).normalized();
    const Eigen::Affine3d pose(Eigen::AngleAxisd(3.0 * number(random), axis));
    const Model a = engine::transformed(plain, pose);
    const Model b = engine::transformed(trimmed, pose);
    const double z = 4.0 * number(random);
    CAPTURE(k, z);
    const Layer expected = layer_at(a, z);
    const Layer layer = layer_at(b, z);
    CHECK(tools::kinds_of(layer, 0.05 * kEpsilon) == tools::kinds_of(expected, 0.05 * kEpsilon));
    const auto loops = closed_loops(layer, 0.01 * kEpsilon);
    const auto expected_loops = closed_loops(expected, 0.01 * kEpsilon);
    CHECK(parity_area(loops) == Approx(parity_area(expected_loops)).epsilon(1e-4));
    CHECK(greatest_difference(loops, expected_loops) < 0.2 * kEpsilon);
  }
}

TEST_CASE("bounds are those of what the loops leave", "[slicing][trim]") {
  const engine::Box3 box = engine::model_bounds(trimmed_box_with_hole({1, 2, 3}, {21, 17, 13}, 4.0));
  CHECK((box.min() - Vector3(1, 2, 3)).norm() < 2e-3);
  CHECK((box.max() - Vector3(21, 17, 13)).norm() < 2e-3);
  // A dome: its top is inside of the loop, nowhere near a trim curve.
  Model dome;
  const AnalyticModel ball = sphere({0, 0, 0}, 5.0);
  engine::Surface cap{ball.model.surfaces.front().nurbs, {}, 0, 0};
  const engine::NurbsSurface& nurbs = cap.nurbs;
  // The part beyond the middle of v: one half of the sphere.
  const double middle = 0.5 * (nurbs.first_v() + nurbs.last_v());
  cap.trim = {polygon_loop({{nurbs.first_u(), middle},
                            {nurbs.last_u(), middle},
                            {nurbs.last_u(), nurbs.last_v()},
                            {nurbs.first_u(), nurbs.last_v()}})};
  dome.surfaces.push_back(cap);
  const engine::Box3 half = engine::model_bounds(dome);
  CHECK(half.sizes().x() == Approx(10.0).margin(2e-3));
  CHECK(half.sizes().z() == Approx(5.0).margin(2e-3));
}

TEST_CASE("neighbours whose trim curves differ by less than epsilon still close", "[slicing][trim]") {
  // The walls stop 4 um short of each other, as files with loose tolerances have it.
  Model model;
  const double gap = 0.0002;
  const engine::TrimLoop square = polygon_loop({{gap, 0}, {1 - gap, 0}, {1 - gap, 1}, {gap, 1}});
  const Vector3 corners[4] = {{0, 0, 0}, {20, 0, 0}, {20, 20, 0}, {0, 20, 0}};
  for (int k = 0; k < 4; ++k) {
    model.surfaces.push_back(
        trimmed_plane(corners[k], corners[(k + 1) % 4] - corners[k], {0, 0, 10}, 0.2, {square}));
  }
  const Layer layer = layer_at(model, 4.0);
  REQUIRE(layer.closed.size() == 1);
  CHECK(layer.open.empty());
  CHECK(parity_area(closed_loops(layer, 1e-3 * kEpsilon)) == Approx(400.0).epsilon(1e-5));
}

}  // namespace
}  // namespace lamina::tests
