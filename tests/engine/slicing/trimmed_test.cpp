// Trimmed surfaces: the same sections as models without trim curves, and closed forms; ends of arcs on the
// trim curves; what lies in the plane.

#include <cmath>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "engine/model_bounds.h"
#include "engine/nurbs/reverse.h"
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

/// A closed cylinder wall as two surfaces that a wave around it parts.
Model parted_cylinder(double radius, double height) {
  const engine::NurbsSurface wall = revolved(segment_profile({radius, 0.0}, {radius, height}), {0, 0, 0});
  const double u0 = wall.first_u();
  const double u1 = wall.last_u();
  const double v0 = wall.first_v();
  const double v1 = wall.last_v();
  constexpr int kWaves = 9;
  engine::NurbsCurve wave{3, {}, {}};
  constexpr int kPoints = 4 * kWaves + 3;
  for (int k = 0; k < kPoints; ++k) {
    const double share = static_cast<double>(k) / (kPoints - 1);
    const double v = v0 + (v1 - v0) * (0.5 + 0.3 * std::sin(2.0 * std::numbers::pi * kWaves * share));
    wave.control_points.emplace_back(u0 + (u1 - u0) * share, v, 0.0, 1.0);
  }
  wave.knots.assign(4, 0.0);
  for (int k = 1; k < kPoints - 3; ++k) wave.knots.push_back(k);
  wave.knots.insert(wave.knots.end(), 4, kPoints - 3.0);
  const auto line = [](double ua, double va, double ub, double vb) {
    return engine::NurbsCurve{1, {0, 0, 1, 1}, {{ua, va, 0, 1}, {ub, vb, 0, 1}}};
  };
  const double middle = 0.5 * (v0 + v1);
  Model model;
  for (const bool lower : {true, false}) {
    engine::Surface surface;
    surface.nurbs = wall;
    if (lower) {
      surface.trim = {{{line(u0, v0, u1, v0), line(u1, v0, u1, middle), engine::reversed(wave),
                        line(u0, middle, u0, v0)}}};
    } else {
      surface.trim = {{{wave, line(u1, middle, u1, v1), line(u1, v1, u0, v1), line(u0, v1, u0, middle)}}};
    }
    model.surfaces.push_back(std::move(surface));
  }
  return model;
}

TEST_CASE("where faces meet in a wave, sections go on without turning back", "[slicing][trim]") {
  constexpr double kRadius = 5.0;
  const Model model = parted_cylinder(kRadius, 10.0);
  for (double z = 0.37; z < 10.0; z += 0.71) {
    CAPTURE(z);
    const engine::LayerChains chains = chains_at(model, z, kEpsilon);
    REQUIRE(chains.closed.size() == 1);
    CHECK(chains.open.empty());
    const engine::Loop loop = loops_of(chains).front();
    double turned = 0.0;
    double turned_in_all = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vector2& at = loop[k];
      const Vector2& next = loop[(k + 1) % loop.size()];
      CHECK(at.norm() == Approx(kRadius).margin(1e-9));
      const double turn = std::atan2(at.x() * next.y() - at.y() * next.x(), at.dot(next));
      turned += turn;
      turned_in_all += std::abs(turn);
    }
    CHECK(std::abs(turned) == Approx(2.0 * std::numbers::pi).epsilon(1e-12));
    CHECK(turned_in_all == Approx(std::abs(turned)).epsilon(1e-12));
  }
}

TEST_CASE("a plane through the top of a standing disc meets it in a point", "[slicing][trim][touch]") {
  // Leaning a little, so that neither axis of the surface is level, and turned against the circle's knots.
  Model model;
  model.surfaces.push_back(
      trimmed_plane({0, 0, 0}, {10, 0, 1}, {-1, 0.5, 10}, 0.1, {circle_loop({0.5, 0.5}, 0.4, false)}));
  const Vector2 slope(1.0, 10.0);  // of the height by u and v
  const double middle = 0.5 * slope.sum();
  for (const double side : {-1.0, 1.0}) {
    const double z = middle + side * 0.4 * slope.norm();
    const Layer layer = layer_at(model, z);
    CAPTURE(z);
    REQUIRE(layer.points.size() == 1);
    const Vector2 at = Vector2(0.5, 0.5) + side * 0.4 * slope.normalized();
    const Vector2 expected(10.0 * at.x() - at.y(), 0.5 * at.y());
    CHECK((layer.points.front().position - expected).norm() < 1e-4);
    CHECK(layer.open.empty());
    CHECK(layer_at(model, z - side * 1e-3).open.size() == 1);
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
