#include "gcode/plan/route.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "gcode/plan/adhesion.h"
#include "gcode/plan/bead.h"
#include "gcode/plan/order.h"
#include "gcode/plan/planner.h"
#include "gcode/plan/seam.h"
#include "gcode/plan/simplify.h"
#include "tests/gcode/shapes.h"

using namespace lamina;
using namespace lamina::gcode;
using namespace lamina::tests;
using engine::Loop;
using engine::Polyline;
using engine::Vector2;
using engine::Vector3;

namespace {

std::vector<LayerToolpath> plan_box(const PlanOptions& options, std::size_t count,
                                    const std::vector<Loop>& loops) {
  Planner planner(options, {}, Vector3::Zero());
  std::vector<LayerToolpath> layers;
  const auto take = [&](std::vector<LayerToolpath> more) {
    layers.insert(layers.end(), more.begin(), more.end());
  };
  for (std::size_t i = 0; i < count; ++i) take(planner.push(region_of(i, 0.2, loops)));
  take(planner.finish());
  return layers;
}

}  // namespace

TEST_CASE("volume is bead area times length on every move") {
  Vector3 from = Vector3::Zero();
  for (const LayerToolpath& layer : plan_box({}, 8, {square({50, 50}, 20), circle({50, 50}, 5, 60)})) {
    double sum = 0.0;
    for (const Move& move : layer.moves) {
      if (move.volume > 0.0) {
        const double area =
            (move.width - move.height) * move.height + std::numbers::pi / 4.0 * move.height * move.height;
        CHECK(move.volume == Approx(area * (move.end - from).norm()).epsilon(1e-12));
        CHECK(move.end.z() == Approx(layer.z));
        CHECK(from.z() == Approx(layer.z));
      }
      sum += move.volume;
      from = move.end;
    }
    CHECK(volume(layer) == Approx(sum).epsilon(1e-12));
  }
}

TEST_CASE("filament is drawn back on long travel, pushed out before the bead, and comes out even") {
  PlanOptions options;
  options.retraction.length = 3.0;
  options.retraction.min_travel = 2.0;
  options.retraction.z_hop = 0.4;
  Vector3 from = Vector3::Zero();
  double drawn = 0.0;
  int long_travels = 0;
  for (const LayerToolpath& layer : plan_box(options, 6, {square({50, 50}, 20), square({90, 50}, 10)})) {
    for (const Move& move : layer.moves) {
      const double way = (move.end - from).head<2>().norm();
      drawn += move.filament;
      if (move.volume > 0.0) CHECK(drawn == 0.0);
      if (move.volume == 0.0 && way > 2.0) {
        CHECK(drawn == -3.0);
        CHECK(move.end.z() == Approx(layer.z + 0.4));
        ++long_travels;
      }
      CHECK((drawn == 0.0 || drawn == -3.0));
      from = move.end;
    }
  }
  CHECK(drawn == 0.0);
  CHECK(long_travels > 12);
}

TEST_CASE("speeds obey the first layer's limit and the hot end") {
  PlanOptions options;
  options.speed.sparse_infill = 300.0;
  FilamentOptions filament;
  filament.max_volumetric_speed = 6.0;
  Planner planner(options, filament, Vector3::Zero());
  std::vector<LayerToolpath> layers;
  for (std::size_t i = 0; i < 12; ++i) {
    for (LayerToolpath& layer : planner.push(region_of(i, 0.2, {square({50, 50}, 30)}))) {
      layers.push_back(std::move(layer));
    }
  }
  double fastest_flow = 0.0;
  for (const LayerToolpath& layer : layers) {
    for (const Move& move : layer.moves) {
      if (move.volume == 0.0) continue;
      if (layer.index == 0) CHECK(move.speed <= options.speed.first_layer);
      fastest_flow = std::max(fastest_flow, move.speed * bead_area(move.width, move.height));
    }
  }
  CHECK(fastest_flow == Approx(6.0));
}

TEST_CASE("walls are laid from the inside out, infill last, island by island") {
  const auto layers = plan_box({}, 3, {square({50, 50}, 20), square({90, 50}, 20)});
  std::vector<Role> roles;
  for (const Move& move : layers[1].moves) {
    if (move.volume > 0.0 && (roles.empty() || roles.back() != move.role)) roles.push_back(move.role);
  }
  const std::vector<Role> island{Role::kInnerWall, Role::kOuterWall, Role::kSolidInfill};
  std::vector<Role> expected = island;
  expected.insert(expected.end(), island.begin(), island.end());
  CHECK(roles == expected);

  PlanOptions outer_first;
  outer_first.wall.order = WallOrder::kOuterFirst;
  const auto turned = plan_box(outer_first, 3, {square({50, 50}, 20)});
  for (const Move& move : turned[1].moves) {
    if (move.volume == 0.0) continue;
    CHECK(move.role == Role::kOuterWall);
    break;
  }
}

TEST_CASE("walls close: they end where they began") {
  for (const LayerToolpath& layer : plan_box({}, 2, {square({50, 50}, 20)})) {
    Vector3 from = Vector3::Zero();
    Vector3 begun = Vector3::Zero();
    Role role = Role::kTravel;
    for (const Move& move : layer.moves) {
      if (move.role == Role::kOuterWall && role != Role::kOuterWall) begun = from;
      if (role == Role::kOuterWall && move.role != Role::kOuterWall) CHECK((from - begun).norm() < 1e-9);
      if (move.volume > 0.0 || move.role == Role::kTravel) role = move.role;
      from = move.end;
    }
  }
}

TEST_CASE("a skirt keeps its distance from the part and is long enough") {
  const engine::Region part{{square({50, 50}, 20), {}}, {square({80, 50}, 10), {}}};
  AdhesionOptions options;
  options.skirt_distance = 4.0;
  options.skirt_loops = 2;
  const auto loops = make_skirt(part, options, 0.45, 0.2, 0.0);
  REQUIRE(loops.size() == 2);
  const Loop hull{{40, 40}, {60, 40}, {85, 45}, {85, 55}, {60, 60}, {40, 60}};
  for (std::size_t i = 0; i < 2; ++i) {
    const double distance = 4.0 + 0.225 + (i == 0 ? bead_spacing(0.45, 0.2) : 0.0);
    for (const Vector2& vertex : loops[i].points) {
      CHECK(distance_to_loops(vertex, {hull}) == Approx(distance).margin(1e-3));
    }
  }
  const double one = engine::perimeter(loops[1].points) * bead_area(0.45, 0.2);
  CHECK(make_skirt(part, options, 0.45, 0.2, 5.5 * one).size() >= 5);
  CHECK(make_skirt({}, options, 0.45, 0.2, 100.0).empty());
}

TEST_CASE("a brim fills its width around the outlines and leaves holes open") {
  const engine::Region ring{{square({50, 50}, 20), {reversed(square({50, 50}, 10))}}};
  AdhesionOptions options;
  options.brim_width = 4.0;
  options.brim_gap = 0.2;
  const auto loops = make_brim(ring, options, 0.45, 0.2);
  const double spacing = bead_spacing(0.45, 0.2);
  REQUIRE(loops.size() == static_cast<std::size_t>(std::lround(4.0 / spacing)));
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const double distance = 0.2 + 0.225 + static_cast<double>(loops.size() - 1 - i) * spacing;
    CHECK(distance_to_loops(loops[i].points.front(), {ring.front().outer}) == Approx(distance).margin(1e-3));
    CHECK_FALSE(inside_loops(loops[i].points.front(), {ring.front().outer}));
  }
}

TEST_CASE("the convex hull is convex, holds every point, and has only corners") {
  const engine::Region star{{{{0, 0}, {5, 1}, {10, 0}, {9, 5}, {10, 10}, {5, 9}, {0, 10}, {1, 5}}, {}},
                            {rectangle(4, 10, 6, 10.5), {}}};
  const Loop hull = convex_hull(star);
  CHECK(hull.size() == 6);
  CHECK(engine::signed_area(hull) == Approx(100.0 + 0.5 * 0.5 * (10.0 + 2.0)));
}

TEST_CASE("seams: nearest, rear, aligned") {
  const Loop box = rectangle(0, 0, 10, 10);
  CHECK(seam_vertex(box, SeamPosition::kNearest, {9, 1}, {}) == 1);
  CHECK(seam_vertex(circle({0, 0}, 5, 40), SeamPosition::kRear, {0, -9}, {}) == 10);
  CHECK(seam_vertex(box, SeamPosition::kAligned, {0, 0}, {{9.5, 10.2}}) == 2);
  // Out of reach of the seam below a corner is chosen, the only one of this drop.
  Loop drop = circle({0, 0}, 5, 40);
  drop[30] = {0, -9};
  CHECK(seam_vertex(drop, SeamPosition::kAligned, {0, 0}, {{100, 100}}) == 30);
  CHECK(seam_vertex(circle({0, 0}, 5, 40), SeamPosition::kAligned, {0, 0}, {}) == 10);
}

TEST_CASE("aligned seams stay on one corner all the way up") {
  Vector3 from = Vector3::Zero();
  std::vector<Vector2> seams;
  for (const LayerToolpath& layer : plan_box({}, 12, {square({50, 50}, 20)})) {
    Role role = Role::kTravel;
    for (const Move& move : layer.moves) {
      if (move.role == Role::kOuterWall && role != Role::kOuterWall) seams.emplace_back(from.head<2>());
      role = move.role;
      from = move.end;
    }
  }
  REQUIRE(seams.size() == 12);
  for (const Vector2& seam : seams) CHECK((seam - seams.front()).norm() < 1e-6);
}

TEST_CASE("simplifying keeps within its tolerance and keeps what matters") {
  Polyline wave;
  for (int i = 0; i <= 500; ++i) wave.emplace_back(0.02 * i, std::sin(0.02 * i));
  for (const double tolerance : {0.001, 0.01, 0.1}) {
    const Polyline less = simplified(wave, tolerance);
    CHECK(less.size() < wave.size() / 4);
    CHECK(less.front() == wave.front());
    CHECK(less.back() == wave.back());
    for (const Vector2& p : wave) {
      double nearest = 1e300;
      for (std::size_t i = 1; i < less.size(); ++i) {
        nearest = std::min(nearest, distance_to_side(p, less[i - 1], less[i]));
      }
      CHECK(nearest <= tolerance + 1e-12);
    }
  }
  Loop box{{0, 0}, {5, 0}, {10, 0}, {10, 10}, {5, 10.0001}, {0, 10}, {0, 5}};
  CHECK(simplified_loop(box, 0.001).size() == 4);
}

TEST_CASE("the nearest path is taken by its nearest possible start") {
  const BeadPath open{Role::kSparseInfill, 0.4, false, {{0, 0}, {10, 0}}};
  const BeadPath closed{Role::kOuterWall, 0.4, true, {{20, 0}, {14, 3}, {20, 6}}};
  CHECK(nearest_path({closed, open}, {9, 0}) == 1);
  CHECK(nearest_path({closed, open}, {13, 3}) == 0);
  CHECK(distance_to_start(open, {5, 0}) == Approx(5.0));
}
