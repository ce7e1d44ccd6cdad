#include <map>

#include <catch2/catch.hpp>

#include "gcode/plan/bead.h"
#include "gcode/plan/plan_error.h"
#include "gcode/plan/planner.h"
#include "tests/gcode/shapes.h"

using namespace lamina;
using namespace lamina::gcode;
using namespace lamina::tests;
using engine::Loop;
using engine::Vector3;

namespace {

constexpr double kThickness = 0.2;

PlanOptions shell_options(std::size_t bottom, std::size_t top) {
  PlanOptions options;
  options.shell = {top, bottom, 0.0, 0.0};
  options.adhesion.type = Adhesion::kNone;
  return options;
}

std::vector<LayerToolpath> plan_all(Planner& planner, const std::vector<LayerRegion>& layers) {
  std::vector<LayerToolpath> finished;
  const auto take = [&](std::vector<LayerToolpath> more) {
    for (LayerToolpath& layer : more) finished.push_back(std::move(layer));
  };
  for (const LayerRegion& layer : layers) take(planner.push(layer));
  take(planner.finish());
  return finished;
}

std::vector<LayerRegion> prism(const std::vector<Loop>& loops, std::size_t count) {
  std::vector<LayerRegion> layers;
  for (std::size_t i = 0; i < count; ++i) layers.push_back(region_of(i, kThickness, loops));
  return layers;
}

std::map<Role, double> volume_by_role(const LayerToolpath& layer) {
  std::map<Role, double> volumes;
  for (const Move& move : layer.moves) {
    if (move.volume > 0.0) volumes[move.role] += move.volume;
  }
  return volumes;
}

/// Whether a bead of one of the roles passes over the point.
bool laid_at(const LayerToolpath& layer, const engine::Vector2& p, const std::vector<Role>& roles) {
  Vector3 from = Vector3::Zero();
  for (const Move& move : layer.moves) {
    const bool wanted = std::find(roles.begin(), roles.end(), move.role) != roles.end();
    if (move.volume > 0.0 && wanted &&
        distance_to_side(p, from.head<2>(), move.end.head<2>()) <= 0.5 * move.width) {
      return true;
    }
    from = move.end;
  }
  return false;
}

}  // namespace

TEST_CASE("a box has its solid layers at the bottom and at the top and none between") {
  const std::size_t bottom = GENERATE(0U, 1U, 4U);
  const std::size_t top = GENERATE(0U, 1U, 5U);
  const std::size_t count = 20;
  Planner planner(shell_options(bottom, top), {}, Vector3::Zero());
  const auto layers = plan_all(planner, prism({square({50, 50}, 30)}, count));
  REQUIRE(layers.size() == count);
  for (const LayerToolpath& layer : layers) {
    auto volumes = volume_by_role(layer);
    CAPTURE(bottom, top, layer.index);
    const bool in_bottom = layer.index < bottom;
    const bool in_top = layer.index + top >= count;
    CHECK((volumes[Role::kSparseInfill] > 0.0) == !(in_bottom || in_top));
    CHECK((volumes[Role::kBottomSurface] > 0.0) == (bottom > 0 && layer.index == 0));
    CHECK((volumes[Role::kTopSurface] > 0.0) == (top > 0 && layer.index == count - 1));
    if (in_bottom || in_top) {
      // Full but for the rounded outer flank, and over by the overlap of infill and walls.
      const double full = 30.0 * 30.0 * kThickness;
      CHECK(volume(layer) > 0.985 * full);
      CHECK(volume(layer) < 1.02 * full);
    }
  }
}

TEST_CASE("shells are at least as thick as asked") {
  PlanOptions options = shell_options(1, 1);
  options.shell.top_min_thickness = 0.7;
  options.shell.bottom_min_thickness = 0.5;
  Planner planner(options, {}, Vector3::Zero());
  const auto layers = plan_all(planner, prism({square({50, 50}, 30)}, 20));
  for (const LayerToolpath& layer : layers) {
    const bool solid = layer.index < 3 || layer.index >= 16;  // 3 x 0.2 >= 0.5 and 4 x 0.2 >= 0.7
    CHECK((volume_by_role(layer)[Role::kSparseInfill] == 0.0) == solid);
  }
}

TEST_CASE("ledges of a stepped pyramid are top surfaces, solid as deep as the shell") {
  // Steps of 10 layers; each is 8 mm narrower on every side than the one below.
  std::vector<LayerRegion> steps;
  for (std::size_t i = 0; i < 30; ++i) {
    steps.push_back(region_of(i, kThickness, {square({50, 50}, i < 10 ? 60.0 : i < 20 ? 44.0 : 28.0)}));
  }
  const std::size_t top = 3;
  PlanOptions options = shell_options(2, top);
  Planner planner(options, {}, Vector3::Zero());
  const auto layers = plan_all(planner, steps);
  for (std::size_t step = 0; step < 2; ++step) {
    const double ledge = 30.0 - 8.0 * static_cast<double>(step) - 4.0;  // middle of the ledge, from the axis
    for (std::size_t depth = 0; depth < 10; ++depth) {
      const LayerToolpath& layer = layers[10 * step + 9 - depth];
      CAPTURE(step, depth);
      // Points along the ledge, off the axis, on all four sides. The lowest layers are solid from below.
      for (int i = 0; i < 9; ++i) {
        const double along = -10.0 + 2.3 * i;
        for (const engine::Vector2& p : {engine::Vector2(50 + ledge, 50 + along),
                                         {50 - ledge, 50 + along},
                                         {50 + along, 50 + ledge},
                                         {50 + along, 50 - ledge}}) {
          if (depth == 0) CHECK(laid_at(layer, p, {Role::kTopSurface}));
          if (depth > 0 && depth < top) CHECK(laid_at(layer, p, {Role::kSolidInfill}));
          if (depth >= top && layer.index >= 2) {
            CHECK_FALSE(laid_at(layer, p, {Role::kTopSurface, Role::kSolidInfill, Role::kBottomSurface}));
          }
        }
      }
      // Under the next step it stays sparse.
      if (layer.index >= 2) CHECK_FALSE(laid_at(layer, {50, 50}, {Role::kTopSurface, Role::kSolidInfill}));
    }
  }
}

TEST_CASE("the underside of an overhang is a bottom surface") {
  std::vector<LayerRegion> mushroom;
  for (std::size_t i = 0; i < 20; ++i) {
    mushroom.push_back(region_of(i, kThickness, {square({50, 50}, i < 10 ? 20.0 : 50.0)}));
  }
  Planner planner(shell_options(3, 3), {}, Vector3::Zero());
  const auto layers = plan_all(planner, mushroom);
  CHECK(laid_at(layers[10], {67, 50}, {Role::kBottomSurface}));
  CHECK(laid_at(layers[12], {67, 50}, {Role::kSolidInfill}));
  CHECK_FALSE(laid_at(layers[13], {67, 50}, {Role::kSolidInfill, Role::kBottomSurface}));
  CHECK_FALSE(laid_at(layers[10], {50, 50}, {Role::kBottomSurface, Role::kSolidInfill}));
}

TEST_CASE("full density leaves no sparse infill") {
  PlanOptions options = shell_options(2, 2);
  options.infill.density = 1.0;
  Planner planner(options, {}, Vector3::Zero());
  for (const LayerToolpath& layer : plan_all(planner, prism({square({50, 50}, 20)}, 10))) {
    CHECK(volume_by_role(layer).count(Role::kSparseInfill) == 0);
    CHECK(volume(layer) == Approx(400.0 * kThickness).epsilon(0.025));
  }
}

TEST_CASE("layers come out as soon as they can, and no more than the shells need are held") {
  const std::size_t top = GENERATE(0U, 1U, 5U);
  const std::size_t bottom = GENERATE(0U, 4U);
  Planner planner(shell_options(bottom, top), {}, Vector3::Zero());
  std::size_t finished = 0;
  for (std::size_t i = 0; i < 60; ++i) {
    for (const LayerToolpath& layer : planner.push(region_of(i, kThickness, {square({20, 20}, 10)}))) {
      CHECK(layer.index == finished);
      ++finished;
    }
    CHECK(finished == (i + 1 > top ? i + 1 - top : 0));
    CHECK(planner.held_layers() <= top + std::max<std::size_t>(bottom, 1) + 1);
  }
  CHECK(finished + planner.finish().size() == 60);
}

TEST_CASE("layers planned in a window are those planned all at once") {
  // The window must not change the result: a part whose lower half decides nothing about the upper one.
  const auto build = [](std::size_t first) {
    std::vector<LayerRegion> layers;
    for (std::size_t i = 0; i < 40; ++i) {
      const double side = 20.0 + 6.0 * static_cast<double>((i / 7) % 3);
      layers.push_back(region_of(first + i, kThickness, {square({50, 50}, side)}));
    }
    return layers;
  };
  Planner planner(shell_options(4, 5), {}, Vector3::Zero());
  Planner late(shell_options(4, 5), {}, Vector3::Zero());
  const auto whole = plan_all(planner, build(0));
  auto part = build(0);
  part.erase(part.begin(), part.begin() + 14);
  const auto upper = plan_all(late, part);
  for (std::size_t i = 24; i < 40; ++i) CHECK(volume_by_role(whole[i]) == volume_by_role(upper[i - 14]));
}

TEST_CASE("layers that cannot be planned are refused") {
  Planner planner({}, {}, Vector3::Zero());
  CHECK_THROWS_AS(planner.push(region_of(0, 0.6, {square({0, 0}, 10)})), PlanError);
  planner.push(region_of(5, 0.2, {square({0, 0}, 10)}));
  CHECK_THROWS_AS(planner.push(region_of(4, 0.2, {square({0, 0}, 10)})), PlanError);
  PlanOptions options;
  options.infill.density = 1.2;
  CHECK_THROWS_AS(Planner(options, {}, Vector3::Zero()), PlanError);
}
