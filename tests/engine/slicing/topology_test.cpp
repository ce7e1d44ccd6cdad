// Contours that cross, touch, coincide or leave gaps.

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "engine/geometry/polygon.h"
#include "tests/engine/slicing/sliced_layers.h"
#include "tests/support/analytic_models.h"
#include "tests/support/contour_measure.h"

namespace lamina::tests {
namespace {

using engine::LayerChains;
using engine::Loop;
using engine::Model;
using engine::NurbsSurface;
using engine::SliceOptions;
using engine::Vector2;
using engine::Vector3;

double area_of(const LayerChains& chains) {
  return parity_area(loops_of(chains));
}

TEST_CASE("overlapping spheres give the union, with exact corners", "[slicing]") {
  const Model model = united("spheres", {sphere({-4, 0, 8}, 8.0).model, sphere({4, 0, 8}, 8.0).model});
  for (const double z : {8.0, 5.0}) {
    const LayerChains chains = chains_at(model, z, 0.02);
    REQUIRE(chains.closed.size() == 1);
    const double radius = std::sqrt(64.0 - (z - 8.0) * (z - 8.0));
    const double corner_y = std::sqrt(radius * radius - 16.0);
    std::size_t corners = 0;
    for (const engine::ContourNode& node : chains.closed.front().nodes) {
      if (!node.corner) continue;
      ++corners;
      CHECK(
          (Vector2(std::abs(node.position.x()), std::abs(node.position.y())) - Vector2(0, corner_y)).norm() <
          1e-6);
    }
    CHECK(corners == 2);
    // Two circles less their lens (circular segments on both sides of x = 0).
    const double half_angle = std::acos(4.0 / radius);
    const double lens = 2.0 * radius * radius * (half_angle - std::sin(half_angle) * std::cos(half_angle));
    CHECK(std::abs(area_of(chains) - (2.0 * std::numbers::pi * radius * radius - lens)) < 0.05 * 0.02 * 80.0);
  }
}

TEST_CASE("a ring of overlapping boxes keeps its hole", "[slicing]") {
  const Model ring =
      united("ring", {box({0, 0, 0}, {20, 5, 5}).model, box({0, 15, 0}, {20, 20, 5}).model,
                      box({-1, -1, 0}, {4, 21, 5}).model, box({16, -1, 0}, {21, 21, 5}).model});
  const LayerChains chains = chains_at(ring, 2.0, 0.05);
  CHECK(chains.closed.size() == 2);
  // Outer outline: two bars 5 x 22 and two 20 x 5 less the overlaps; hole 12 x 10.
  CHECK(std::abs(area_of(chains) - (2 * 5.0 * 22.0 + 2 * 5.0 * 12.0)) < 1e-6);
}

TEST_CASE("boxes side by side become one, boxes touching at an edge stay two", "[slicing]") {
  for (const double angle : {0.0, 0.4}) {
    const Eigen::Affine3d turn(Eigen::AngleAxisd(angle, Vector3::UnitZ()));
    const Model beside = engine::transformed(
        united("beside", {box({0, 0, 0}, {10, 10, 5}).model, box({10, 2, 0}, {15, 8, 5}).model}), turn);
    const LayerChains joined = chains_at(beside, 2.0, 0.05);
    CAPTURE(angle);
    CHECK(joined.closed.size() == 1);
    CHECK(std::abs(area_of(joined) - 130.0) < 1e-4);
    const Model diagonal = engine::transformed(
        united("diagonal", {box({0, 0, 0}, {10, 10, 5}).model, box({10, 10, 0}, {15, 15, 5}).model}), turn);
    const LayerChains apart = chains_at(diagonal, 2.0, 0.05);
    CHECK(apart.closed.size() == 2);
    CHECK(std::abs(area_of(apart) - 125.0) < 1e-4);
  }
}

TEST_CASE("a hole that touches the outer wall stays a hole", "[slicing]") {
  const Model outer = upright_cylinder({0, 0, 0}, 10.0, 5.0).model;
  const Model hole = upright_cylinder({6, 0, 0}, 4.0, 5.0).model;  // touches at (10, 0)
  const LayerChains chains = chains_at(united("touching hole", {outer, hole}), 2.0, 0.05);
  const double area = std::numbers::pi * (100.0 - 16.0);
  CHECK(std::abs(area_of(chains) - area) < 0.05 * 0.05 * 100.0);
  CHECK(chains.open.empty());
}

TEST_CASE("nested shells and walls thinner than a cell are kept apart", "[slicing]") {
  const double epsilon = 0.1;
  for (const double wall : {1.0, 0.15, 0.02}) {
    const AnalyticModel thin = tube({0, 0, 0}, 8.0 - wall, 8.0, 10.0);
    const LayerChains chains = chains_at(thin.model, 4.0, epsilon);
    CAPTURE(wall);
    REQUIRE(chains.closed.size() == 2);
    const double area = std::numbers::pi * (64.0 - (8.0 - wall) * (8.0 - wall));
    CHECK(std::abs(area_of(chains) - area) < 0.05 * epsilon * 60.0);
  }
}

TEST_CASE("normals reversed or mixed, surfaces doubled: the same contours", "[slicing]") {
  const std::vector<Model> models{
      united("a", {sphere({-4, 0, 8}, 8.0).model, sphere({4, 0, 8}, 8.0).model}),
      united("b", {box({0, 0, 0}, {10, 10, 10}).model, box({5, 5, 0}, {15, 15, 10}).model}),
      tube({0, 0, 0}, 5.0, 8.0, 10.0).model};
  for (const Model& model : models) {
    const LayerChains expected = chains_at(model, 5.5, 0.02);
    Model mixed = model;
    for (std::size_t k = 0; k < mixed.surfaces.size(); k += 2) {
      mixed.surfaces[k].nurbs = engine::transposed(mixed.surfaces[k].nurbs);
    }
    Model doubled = model;
    doubled.surfaces.insert(doubled.surfaces.end(), mixed.surfaces.begin(), mixed.surfaces.end());
    for (const Model& variant : {mixed, doubled}) {
      const LayerChains chains = chains_at(variant, 5.5, 0.02);
      CHECK(chains.closed.size() == expected.closed.size());
      CHECK(chains.open.empty());
      CHECK(greatest_difference(loops_of(chains), loops_of(expected)) < 2.0 * 0.05 * 0.02);
      CHECK(std::abs(area_of(chains) - area_of(expected)) < 0.05 * 0.02 * 100.0);
    }
  }
}

Model gapped_cylinder(double gap) {
  // Four quarter walls; the first one stops short by `gap`.
  std::vector<NurbsSurface> walls;
  const double quarter = 0.5 * std::numbers::pi;
  for (int k = 0; k < 4; ++k) {
    const double shortened = k == 0 ? gap / 10.0 : 0.0;
    walls.push_back(cylinder_patch({0, 0, 0}, 10.0, k * quarter, (k + 1) * quarter - shortened, 5.0));
  }
  return model_of("gapped", walls);
}

TEST_CASE("gaps are bridged and reported, up to the limit", "[slicing]") {
  engine::SliceOptions options;
  options.epsilon = 0.05;
  options.longest_bridge = 0.5;
  for (const double gap : {0.004, 0.04, 0.3}) {
    const auto [chains, report] = reported_chains_at(gapped_cylinder(gap), 2.0, options);
    CAPTURE(gap);
    REQUIRE(chains.closed.size() == 1);
    CHECK(chains.open.empty());
    CHECK(std::abs(area_of(chains) - 100.0 * std::numbers::pi) < 0.05 * 0.05 * 63.0 + gap * gap);
    REQUIRE(report.bridged_gaps.size() == 1);
    const engine::BridgedGap& bridged = report.bridged_gaps.front();
    CHECK(std::abs(bridged.width() - gap) < 1e-3 * gap + 1e-6);
    CHECK((bridged.from - Vector2(0, 10)).norm() < gap + 1e-6);
    std::size_t inexact = 0;
    for (const engine::ContourNode& node : chains.closed.front().nodes) inexact += node.exact ? 0 : 1;
    CHECK(inexact == 2);
  }
  const auto [chains, report] = reported_chains_at(gapped_cylinder(0.8), 2.0, options);
  CHECK(chains.closed.empty());
  CHECK(chains.open.size() == 1);
  REQUIRE(report.open_gaps.size() == 2);
  CHECK(std::abs(report.open_gaps.front().width() - 0.8) < 0.01);
}

TEST_CASE("an end that stops beside another chain is led to it across a gap wider than epsilon",
          "[slicing]") {
  // The front wall overshoots both corners, by 2 mm; the side walls stop 0.3 mm short of it.
  const auto wall = [](const Vector2& from, const Vector2& to) {
    return bilinear({from.x(), from.y(), 0}, {to.x(), to.y(), 0}, {from.x(), from.y(), 5},
                    {to.x(), to.y(), 5});
  };
  const Model room = model_of("room", {wall({-2, 0}, {12, 0}), wall({10, 0.3}, {10, 10}),
                                       wall({10, 10}, {0, 10}), wall({0, 10}, {0, 0.3})});
  engine::SliceOptions options;
  options.epsilon = 0.05;
  const auto [chains, report] = reported_chains_at(room, 2.0, options);
  REQUIRE(chains.closed.size() == 1);
  CHECK(std::abs(area_of(chains) - 100.0) < 1e-4);
  CHECK(chains.open.size() == 2);
  CHECK(report.bridged_gaps.size() == 2);
  for (const engine::BridgedGap& gap : report.bridged_gaps) CHECK(gap.width() == Approx(0.3));
}

TEST_CASE("a bridge runs straight across, not along the tangents at its ends", "[slicing]") {
  // Three walls of a narrow room: the section's ends both point out of the missing one.
  const auto wall = [](const Vector2& from, const Vector2& to) {
    return bilinear({from.x(), from.y(), 0}, {to.x(), to.y(), 0}, {from.x(), from.y(), 5},
                    {to.x(), to.y(), 5});
  };
  const Model room =
      model_of("room", {wall({0, 0}, {0, 10}), wall({0, 10}, {0.4, 10}), wall({0.4, 10}, {0.4, 0})});
  engine::SliceOptions options;
  options.epsilon = 0.05;
  engine::Slicer slicer(room, {{2.0, 2.0, 2.0}}, options);
  const engine::Layer layer = *slicer.next();
  REQUIRE(layer.closed.size() == 1);
  for (const Vector2& point : engine::flatten(layer.closed.front().curve, 1e-4)) {
    CHECK(point.y() > -1e-6);
    CHECK(point.x() > -1e-6);
    CHECK(point.x() < 0.4 + 1e-6);
  }
  CHECK(std::abs(engine::signed_area(layer.closed.front().curve)) == Approx(4.0));
}

TEST_CASE("a wall between two solids bounds nothing and stays as an open contour", "[slicing]") {
  Model model = united("dumbbell", {box({0, 0, 0}, {2, 2, 5}).model, box({12, 0, 0}, {14, 2, 5}).model});
  engine::Surface between;
  between.nurbs = bilinear({1.5, 1, 0}, {12.5, 1, 0}, {1.5, 1, 5}, {12.5, 1, 5});
  model.surfaces.push_back(between);
  const LayerChains chains = chains_at(model, 2.0, 0.05);
  CHECK(chains.closed.size() == 2);
  CHECK(std::abs(area_of(chains) - 8.0) < 1e-6);
  REQUIRE(chains.open.size() == 1);
  CHECK((chains.open.front().nodes.front().position - chains.open.front().nodes.back().position).norm() ==
        Approx(10.0));
}

TEST_CASE("walls that overshoot at their corners are cut there", "[slicing]") {
  // A square room of four walls, each longer than needed by 1 mm at both ends.
  const auto wall = [](const Vector2& a, const Vector2& b) {
    const Vector2 along = (b - a).normalized();
    const Vector2 from = a - along;
    const Vector2 to = b + along;
    return bilinear({from.x(), from.y(), 0}, {to.x(), to.y(), 0}, {from.x(), from.y(), 5},
                    {to.x(), to.y(), 5});
  };
  const Model room = model_of("room", {wall({0, 0}, {10, 0}), wall({10, 0}, {10, 10}),
                                       wall({10, 10}, {0, 10}), wall({0, 10}, {0, 0})});
  engine::SliceOptions options;
  options.epsilon = 0.05;
  const auto [chains, report] = reported_chains_at(room, 2.0, options);
  REQUIRE(chains.closed.size() == 1);
  CHECK(std::abs(area_of(chains) - 100.0) < 1e-4);
  // The eight ends stand outside: nothing vanishes.
  CHECK(chains.open.size() == 8);
}

TEST_CASE("ends of walls that pass each other sideways are joined over a few epsilon", "[slicing]") {
  // A square room, one wall in two parts: 0.03 mm apart, and 0.02 mm of each lie side by side.
  const auto wall = [](const Vector2& a, const Vector2& b) {
    return bilinear({a.x(), a.y(), 0}, {b.x(), b.y(), 0}, {a.x(), a.y(), 5}, {b.x(), b.y(), 5});
  };
  const Model room =
      model_of("room", {wall({0, 0}, {5.01, 0}), wall({4.99, 0.03}, {10, 0.03}), wall({10, 0.03}, {10, 10}),
                        wall({10, 10}, {0, 10}), wall({0, 10}, {0, 0})});
  engine::SliceOptions options;
  options.epsilon = 0.01;
  const auto [chains, report] = reported_chains_at(room, 2.0, options);
  REQUIRE(chains.closed.size() == 1);
  CHECK(chains.open.empty());
  CHECK(std::abs(area_of(chains) - (100.0 - 5.0 * 0.03)) < 0.03 * 0.02);
  REQUIRE(report.bridged_gaps.size() == 1);
  CHECK(report.bridged_gaps.front().width() == Approx(std::hypot(0.03, 0.02)));
}

TEST_CASE("a needle whose sides have changed places does not vanish", "[slicing]") {
  // On top of a box a needle 3 mm long and 0.002 mm wide, its left side on the right.
  const std::vector<Vector2> corners{{0, 0}, {10, 0}, {10, 5}, {5.0, 5}, {5.001, 8}, {5.002, 5}, {0, 5}};
  std::vector<engine::NurbsSurface> walls;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2& a = corners[k];
    const Vector2& b = corners[(k + 1) % corners.size()];
    walls.push_back(bilinear({a.x(), a.y(), 0}, {b.x(), b.y(), 0}, {a.x(), a.y(), 5}, {b.x(), b.y(), 5}));
  }
  const LayerChains chains = chains_at(model_of("needle", walls), 2.0, 0.05);
  CHECK(std::abs(area_of(chains) - 50.0) < 0.01);
  CHECK(distance_to_loops({5.001, 8}, loops_of(chains)) < 1e-6);
}

TEST_CASE("a wall that ends at another is led to it", "[slicing]") {
  // A box with a partition that stops 0.02 mm short of both walls.
  Model model = box({0, 0, 0}, {10, 10, 5}).model;
  engine::Surface partition;
  partition.nurbs = bilinear({5, 0.02, 0}, {5, 9.98, 0}, {5, 0.02, 5}, {5, 9.98, 5});
  model.surfaces.push_back(partition);
  engine::SliceOptions options;
  options.epsilon = 0.05;
  const auto [chains, report] = reported_chains_at(model, 2.0, options);
  REQUIRE(chains.closed.size() == 1);
  CHECK(std::abs(area_of(chains) - 100.0) < 1e-6);
  CHECK(chains.open.empty());
  CHECK(report.bridged_gaps.size() == 2);
  CHECK(report.dropped_length > 9.9);  // the partition is reported, not lost
}

TEST_CASE("the arrangement gives the same contours as the chains alone", "[slicing]") {
  SliceOptions all;
  all.unite_all = true;
  const std::vector<std::pair<Model, double>> cases{{sphere({0, 0, 0}, 10.0).model, 3.0},
                                                    {tube({0, 0, 0}, 5.0, 8.0, 10.0).model, 3.0},
                                                    {standing_torus({0, 0, 20}, 15.0, 5.0).model, 20.0},
                                                    {box_with_hole({0, 0, 0}, {20, 15, 10}, 4.0).model, 3.0}};
  for (const auto& [model, z] : cases) {
    const LayerChains direct = chains_at(model, z, 0.02);
    const LayerChains arranged = chains_at(model, z, 0.02, all);
    REQUIRE(direct.closed.size() == arranged.closed.size());
    CHECK(std::abs(area_of(direct) - area_of(arranged)) < 1e-9);
    CHECK(greatest_difference(loops_of(direct), loops_of(arranged)) < 1e-9);
    std::size_t corners = 0;
    for (const auto& chain : direct.closed) {
      for (const auto& node : chain.nodes) corners += node.corner ? 1 : 0;
    }
    for (const auto& chain : arranged.closed) {
      for (const auto& node : chain.nodes) corners -= node.corner ? 1 : 0;
    }
    CHECK(corners == 0);
  }
}

}  // namespace
}  // namespace lamina::tests
