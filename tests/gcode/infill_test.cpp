#include "gcode/plan/infill.h"

#include <cmath>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "gcode/plan/bead.h"
#include "gcode/plan/raster.h"
#include "tests/gcode/shapes.h"

using namespace lamina;
using namespace lamina::gcode;
using namespace lamina::tests;
using engine::Loop;
using engine::Polyline;
using engine::Vector2;

namespace {

double total_length(const std::vector<BeadPath>& paths) {
  double sum = 0.0;
  for (const BeadPath& path : paths) sum += engine::length(path.points);
  return sum;
}

/// How far points along the paths lie outside the loops, at worst.
double worst_outside(const std::vector<BeadPath>& paths, const std::vector<Loop>& loops) {
  double worst = 0.0;
  for (const BeadPath& path : paths) {
    for (std::size_t i = 1; i < path.points.size(); ++i) {
      for (int step = 0; step <= 20; ++step) {
        const Vector2 p = path.points[i - 1] + 0.05 * step * (path.points[i] - path.points[i - 1]);
        if (!inside_loops(p, loops)) worst = std::max(worst, distance_to_loops(p, loops));
      }
    }
  }
  return worst;
}

double distance_to_paths(const Vector2& p, const std::vector<BeadPath>& paths) {
  double nearest = 1e300;
  for (const BeadPath& path : paths) {
    for (std::size_t i = 1; i < path.points.size(); ++i) {
      nearest = std::min(nearest, distance_to_side(p, path.points[i - 1], path.points[i]));
    }
  }
  return nearest;
}

}  // namespace

TEST_CASE("raster lines cross a rectangle at their heights") {
  const engine::Polygon box{rectangle(0, 0, 10, 4), {}};
  const auto chains = raster(box, {0.0, 1.0, 0.0}, 0.0);
  REQUIRE(chains.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(chains[i].size() == 2);
    CHECK(chains[i].front().y() == Approx(0.5 + static_cast<double>(i)));
    CHECK(engine::length(chains[i]) == Approx(10.0));
  }
}

TEST_CASE("neighbouring lines are joined along the boundary into one zigzag") {
  const auto chains = raster({rectangle(0, 0, 10, 4), {}}, {0.0, 1.0, 0.0}, 1.5);
  REQUIRE(chains.size() == 1);
  CHECK(engine::length(chains.front()) == Approx(4 * 10.0 + 3 * 1.0));
  // Not where the way is longer than allowed.
  CHECK(raster({rectangle(0, 0, 10, 4), {}}, {0.0, 1.0, 0.0}, 0.9).size() == 4);
}

TEST_CASE("a hole divides lines, and links go around its corners") {
  const engine::Polygon ring{rectangle(0, 0, 10, 10), {reversed(rectangle(4, 4, 6, 6))}};
  double length = 0.0;
  for (const Polyline& chain : raster(ring, {0.0, 1.0, 0.0}, 0.0)) length += engine::length(chain);
  CHECK(length == Approx(10 * 10.0 - 2 * 2.0));
  for (const Polyline& chain : raster(ring, {0.3, 0.7, 0.1}, 5.0)) {
    for (std::size_t i = 1; i < chain.size(); ++i) {
      const Vector2 middle = 0.5 * (chain[i - 1] + chain[i]);
      const std::vector<Loop> loops{ring.outer, ring.holes.front()};
      CHECK((inside_loops(middle, loops) || distance_to_loops(middle, loops) < 1e-9));
    }
  }
}

TEST_CASE("lines through vertices are counted once") {
  // Corners exactly on the lines at 0.5, 1.5, ...
  const Loop diamond{{0, -2.5}, {2.5, 0.5}, {0, 3.5}, {-2.5, 0.5}};
  for (const Polyline& chain : raster({diamond, {}}, {0.0, 1.0, 0.0}, 0.0)) {
    CHECK(chain.size() == 2);
    CHECK((chain.front() - chain.back()).norm() <= 5.0 + 1e-9);
    CHECK(std::abs(chain.front().x()) == Approx(2.5 * (1.0 - std::abs(chain.front().y() - 0.5) / 3.0)));
  }
}

TEST_CASE("sparse infill has the density asked for") {
  const double side = 60.0;
  const engine::Region area{{square({100, 100}, side), {}}};
  InfillOptions options;
  options.anchor_max = 0.0;
  options.pattern = GENERATE(InfillPattern::kLines, InfillPattern::kGrid);
  options.angle = GENERATE(0.0, 30.0, 45.0);
  for (const double density : {0.1, 0.2, 0.4, 0.8}) {
    for (const double height : {0.1, 0.3}) {
      for (const std::size_t layer : {0U, 1U}) {
        options.density = density;
        const auto paths = fill_sparse(area, options, 0.45, height, layer);
        const double spacing = bead_spacing(0.45, height);
        // Lines are clipped half a spacing inside the area; a line more or less at the edge is chance.
        const double reach = (side - spacing) * (side - spacing);
        const double line = side * spacing * (options.pattern == InfillPattern::kGrid ? 2.0 : 1.0);
        CAPTURE(density, height, layer, options.angle);
        CHECK(std::abs(total_length(paths) * spacing - density * reach) < line);
        CHECK(worst_outside(paths, {area.front().outer}) == 0.0);
      }
    }
  }
}

TEST_CASE("layers of one direction repeat, the next one is turned by a right angle") {
  const engine::Region area{{square({100, 100}, 30), {}}};
  InfillOptions options;
  options.anchor_max = 0.0;
  const auto first = fill_sparse(area, options, 0.45, 0.2, 0);
  const auto second = fill_sparse(area, options, 0.45, 0.2, 1);
  const auto third = fill_sparse(area, options, 0.45, 0.2, 2);
  REQUIRE(first.size() == third.size());
  for (std::size_t i = 0; i < first.size(); ++i) CHECK(first[i].points == third[i].points);
  const Vector2 a = first.front().points[1] - first.front().points[0];
  const Vector2 b = second.front().points[1] - second.front().points[0];
  CHECK(a.dot(b) == Approx(0.0).margin(1e-9));
}

TEST_CASE("solid infill lays area times height") {
  const double height = GENERATE(0.1, 0.2, 0.3);
  const double angle = GENERATE(0.0, 45.0, 120.0);
  const std::vector<engine::Region> areas{
      {{rectangle(10, 10, 50, 37.3), {}}},
      {{circle({40, 40}, 15, 200), {reversed(circle({43, 41}, 6, 100))}}},
      {{{{0, 0}, {30, 0}, {30, 20}, {18, 20}, {18, 9}, {12, 9}, {12, 20}, {0, 20}}, {}}},
  };
  for (const engine::Region& area : areas) {
    const auto paths = fill_solid(area, Role::kSolidInfill, 0.45, height, angle);
    double volume = 0.0;
    for (const BeadPath& path : paths) volume += engine::length(path.points) * bead_area(path.width, height);
    CHECK(volume == Approx(engine::area(area) * height).epsilon(0.02));
  }
}

TEST_CASE("solid infill covers its area and stays inside it") {
  const engine::Polygon part{circle({40, 40}, 15, 200), {reversed(rectangle(36, 35, 45, 43))}};
  const std::vector<Loop> loops{part.outer, part.holes.front()};
  const double angle = GENERATE(0.0, 45.0);
  const auto paths = fill_solid({part}, Role::kSolidInfill, 0.45, 0.2, angle);
  CHECK(worst_outside(paths, loops) == 0.0);
  for (const BeadPath& path : paths) {
    for (const Vector2& p : path.points)
      CHECK(distance_to_loops(p, loops) > 0.5 * bead_spacing(path.width, 0.2) - 0.01);
  }
  const unsigned seed = 7;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(25.0, 55.0);
  int inside = 0;
  int bare = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vector2 p(place(random), place(random));
    if (!inside_loops(p, loops)) continue;
    ++inside;
    bare += distance_to_paths(p, paths) > 0.5 * 0.45 ? 1 : 0;
  }
  REQUIRE(inside > 1500);
  CHECK(bare < inside / 50);  // slivers at the edge, where a line's end turns
}

TEST_CASE("lines of solid infill are evenly spaced, with the width that fills the gap") {
  const auto paths = fill_solid({{rectangle(0, 0, 20, 10.3), {}}}, Role::kTopSurface, 0.45, 0.2, 0.0);
  REQUIRE(paths.size() == 1);
  const double nominal = bead_spacing(0.45, 0.2);
  const double lines = std::round(10.3 / nominal);
  CHECK(bead_spacing(paths.front().width, 0.2) == Approx(10.3 / lines));
  CHECK(paths.front().role == Role::kTopSurface);
  CHECK(paths.front().points.front().y() == Approx(0.5 * 10.3 / lines));
}
