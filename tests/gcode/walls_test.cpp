#include "gcode/plan/walls.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "gcode/plan/bead.h"
#include "gcode/region/polygon_clipping.h"
#include "tests/gcode/shapes.h"

using namespace lamina;
using namespace lamina::gcode;
using namespace lamina::tests;
using engine::Loop;

TEST_CASE("beads side by side at their spacing fill the layer") {
  for (const double height : {0.08, 0.2, 0.3}) {
    for (const double width : {0.3, 0.45, 0.8}) {
      // The cross-section by its definition: a rectangle and two half discs.
      const double area = (width - height) * height + std::numbers::pi * height * height / 4.0;
      CHECK(bead_area(width, height) == Approx(area).epsilon(1e-12));
      CHECK(bead_spacing(width, height) * height == Approx(area).epsilon(1e-12));
      CHECK(bead_width(bead_spacing(width, height), height) == Approx(width).epsilon(1e-12));
    }
  }
}

TEST_CASE("every wall vertex lies at its level's depth below the outline") {
  // A concave outline with a square hole: reflex corners on both.
  const Loop outline{{0, 0}, {30, 0}, {30, 20}, {18, 20}, {18, 9}, {12, 9}, {12, 20}, {0, 20}};
  const Loop hole = reversed(square({24, 6}, 3));
  const engine::Polygon polygon{outline, {hole}};
  const double height = GENERATE(0.1, 0.2, 0.3);
  const double outer = GENERATE(0.42, 0.5);
  const double inner = GENERATE(0.40, 0.45);
  const WallWidths widths{outer, inner, height, 0.0};
  const Walls walls = make_walls(polygon, 4, widths);
  REQUIRE(walls.levels.size() == 4);
  const double s_outer = outer - height * (1.0 - std::numbers::pi / 4.0);
  const double s_inner = inner - height * (1.0 - std::numbers::pi / 4.0);
  for (std::size_t level = 0; level < 4; ++level) {
    const double depth =
        level == 0 ? 0.5 * outer
                   : 0.5 * outer + 0.5 * (s_outer + s_inner) + static_cast<double>(level - 1) * s_inner;
    CHECK(walls.levels[level].size() == 2);
    for (const Loop& loop : walls.levels[level]) {
      for (const engine::Vector2& vertex : loop) {
        CHECK(distance_to_loops(vertex, {outline, hole}) == Approx(depth).margin(0.003));
      }
    }
  }
  // What is left inside begins half a spacing further in.
  const double depth = 0.5 * outer + 0.5 * s_outer + 3.0 * s_inner;
  for (const engine::Polygon& inside : walls.inside) {
    for (const engine::Vector2& vertex : inside.outer) {
      CHECK(distance_to_loops(vertex, {outline, hole}) == Approx(depth).margin(0.005));
    }
  }
}

TEST_CASE("walls of a square are squares: corners stay sharp") {
  const Walls walls = make_walls({square({5, 5}, 20), {}}, 3, {0.45, 0.45, 0.2, 0.0});
  const double spacing = bead_spacing(0.45, 0.2);
  REQUIRE(walls.levels.size() == 3);
  for (std::size_t level = 0; level < 3; ++level) {
    const double side = 20.0 - 0.45 - 2.0 * static_cast<double>(level) * spacing;
    REQUIRE(walls.levels[level].size() == 1);
    CHECK(walls.levels[level].front().size() == 4);
    CHECK(engine::perimeter(walls.levels[level].front()) == Approx(4.0 * side).epsilon(1e-6));
  }
  CHECK(walls.narrow_area == Approx(0.0).margin(1e-6));
}

TEST_CASE("walls and inside together have the area of the part") {
  const engine::Polygon ring{circle({0, 0}, 12, 256), {reversed(circle({0, 0}, 5, 256))}};
  const WallWidths widths{0.45, 0.45, 0.2, 0.0};
  const Walls walls = make_walls(ring, 3, widths);
  double covered = engine::area(walls.inside);
  double outlines = 0.0;
  for (const auto& level : walls.levels) {
    for (const Loop& loop : level) covered += engine::perimeter(loop) * bead_spacing(0.45, 0.2);
  }
  for (const Loop& loop : {ring.outer, ring.holes.front()}) outlines += engine::perimeter(loop);
  // The outer flank is rounded: it lacks (width - spacing) / 2 along the outline.
  const double rounding = 0.5 * (0.45 - bead_spacing(0.45, 0.2)) * outlines;
  CHECK(covered == Approx(engine::area({ring}) - rounding).epsilon(2e-3));
}

TEST_CASE("the inside overlaps the innermost wall by what was asked") {
  const double spacing = bead_spacing(0.45, 0.2);
  const double overlap = 0.09;
  const Walls walls = make_walls({square({0, 0}, 20), {}}, 2, {0.45, 0.45, 0.2, overlap});
  const double side = 20.0 - 2.0 * (0.225 + spacing + 0.5 * spacing - overlap);
  CHECK(engine::area(walls.inside) == Approx(side * side).epsilon(1e-6));
  // Without walls there is nothing to overlap with.
  CHECK(engine::area(make_walls({square({0, 0}, 20), {}}, 0, {0.45, 0.45, 0.2, overlap}).inside) ==
        Approx(400.0).epsilon(1e-6));
}

TEST_CASE("what is too narrow for a wall is counted, not lost") {
  // A 0.3 mm fin on a block.
  const engine::Region finned = unite({{{square({0, 0}, 10), {}}}, {{rectangle(4, -0.15, 9, 0.15), {}}}});
  const Walls walls = make_walls(finned.front(), 2, {0.45, 0.45, 0.2, 0.0});
  CHECK(walls.narrow_area == Approx(4.0 * 0.3).margin(0.05));
  const Walls none = make_walls({rectangle(0, 0, 10, 0.4), {}}, 2, {0.45, 0.45, 0.2, 0.0});
  CHECK(none.levels.empty());
  CHECK(none.inside.empty());
  CHECK(none.narrow_area == Approx(4.0));
}

TEST_CASE("inner walls are left out where they would pile up") {
  // 1.2 mm wide: an outer loop has room, a second one does not.
  const Walls walls = make_walls({rectangle(0, 0, 20, 1.2), {}}, 3, {0.45, 0.45, 0.2, 0.0});
  CHECK(walls.levels.size() == 1);
}
