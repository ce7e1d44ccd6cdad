#include <cmath>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "gcode/region/layer_region.h"
#include "gcode/region/loop_crossings.h"
#include "gcode/region/polygon_clipping.h"
#include "tests/gcode/shapes.h"

using namespace lamina;
using namespace lamina::gcode;
using namespace lamina::tests;
using engine::Loop;
using engine::Region;

namespace {

/// The promise of engine::Region that can be checked loop by loop.
void check_winding(const Region& region) {
  for (const engine::Polygon& polygon : region) {
    CHECK(engine::signed_area(polygon.outer) > 0.0);
    for (const Loop& hole : polygon.holes) {
      CHECK(engine::signed_area(hole) < 0.0);
      CHECK(inside_loops(hole.front(), {polygon.outer}));
    }
  }
}

double regular_polygon_area(double radius, int corners) {
  return 0.5 * corners * radius * radius * std::sin(2.0 * std::numbers::pi / corners);
}

/// Two parabolas: quadratic Bezier pieces from (0, 0) over (5, 4) to (10, 0) and back over (5, -4).
engine::PieceCurve parabola_lens() {
  engine::PlanarCurve curve;
  curve.degree = 2;
  curve.knots = {0, 0, 0, 1, 1, 2, 2, 2};
  curve.control_points = {{0, 0}, {5, 4}, {10, 0}, {5, -4}, {0, 0}};
  return {{curve}, true};
}

}  // namespace

TEST_CASE("contours nest by parity, whatever their direction") {
  const Loop outer = square({0, 0}, 10);
  const Loop hole = square({0, 0}, 6);
  const Loop pin = square({0, 0}, 2);
  for (const auto& loops : {std::vector<Loop>{outer, hole, pin},
                            {pin, hole, outer},
                            {reversed(outer), hole, pin},
                            {outer, reversed(hole), reversed(pin)}}) {
    const LayerRegion layer = region_of(0, 0.2, loops);
    CHECK(engine::area(layer.region) == Approx(100.0 - 36.0 + 4.0).epsilon(1e-9));
    CHECK(layer.region.size() == 2);
    CHECK(layer.crossing_contours == 0);
    check_winding(layer.region);
  }
}

TEST_CASE("an annulus has the area between its circles") {
  const int corners = 200;
  const Region region = fill_contours({circle({50, 40}, 10, corners), circle({50, 40}, 4, corners)}).region;
  REQUIRE(region.size() == 1);
  REQUIRE(region.front().holes.size() == 1);
  CHECK(engine::area(region) ==
        Approx(regular_polygon_area(10, corners) - regular_polygon_area(4, corners)).epsilon(1e-6));
  check_winding(region);
}

TEST_CASE("solids that overlap are united, with their own holes") {
  SECTION("two squares") {
    const LayerRegion layer = region_of(0, 0.2, {rectangle(0, 0, 10, 10), rectangle(6, 4, 16, 14)});
    CHECK(layer.crossing_contours == 1);
    CHECK(layer.region.size() == 1);
    CHECK(engine::area(layer.region) == Approx(100.0 + 100.0 - 4.0 * 6.0).epsilon(1e-9));
  }
  SECTION("a plate with a bore and a bar across one end") {
    // The bore stays open: it lies in the plate alone.
    const Region region =
        fill_contours({rectangle(0, 0, 20, 10), square({5, 5}, 4), rectangle(15, -5, 25, 15)}).region;
    CHECK(engine::area(region) == Approx(200.0 - 16.0 + 200.0 - 50.0).epsilon(1e-9));
    check_winding(region);
  }
  SECTION("a bore that the other solid half fills") {
    const Region region =
        fill_contours({rectangle(0, 0, 20, 10), square({5, 5}, 4), rectangle(5, -5, 25, 15)}).region;
    CHECK(engine::area(region) == Approx(200.0 - 16.0 + 400.0 - (15.0 * 10.0 - 2.0 * 4.0)).epsilon(1e-9));
  }
  SECTION("three in a chain, and a fourth apart") {
    const Region region = fill_contours({rectangle(0, 0, 4, 4), rectangle(3, 0.5, 7, 3.5),
                                         rectangle(6, 0, 10, 4), rectangle(20, 0, 21, 1)})
                              .region;
    CHECK(region.size() == 2);
    CHECK(engine::area(region) == Approx(16.0 + 12.0 + 16.0 - 3.0 - 3.0 + 1.0).epsilon(1e-9));
  }
}

TEST_CASE("touching contours do not count as crossing") {
  CHECK(crossing_loops({rectangle(0, 0, 1, 1), rectangle(1, 0, 2, 1)}).empty());
  CHECK(crossing_loops({rectangle(0, 0, 4, 4), rectangle(1, 1, 2, 2)}).empty());
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
  CHECK(crossing_loops({rectangle(0, 0, 1, 1), rectangle(5, 5, 6, 6), rectangle(0.5, 0.5, 2, 2)}) ==
        Pairs{{0, 2}});
}

TEST_CASE("planar contours are filled between their curves and united with the rest") {
  engine::Layer layer = layer_of(3, 0.2, {rectangle(0, 0, 10, 10)});
  layer.planar.push_back({closed_curve(rectangle(8, 0, 20, 10)), {closed_curve(square({15, 5}, 2))}});
  const LayerRegion result = make_region(layer, {});
  CHECK(engine::area(result.region) == Approx(200.0 - 4.0).epsilon(1e-9));
  CHECK(result.region.size() == 1);
  CHECK(result.planar_contours == 1);
}

TEST_CASE("open contours, touch curves and touch points bound no area but are counted") {
  engine::Layer layer = layer_of(0, 0.2, {square({0, 0}, 2)});
  layer.open.push_back({open_curve({{5, 5}, {9, 5}, {9, 9}}), true});
  layer.open.push_back({open_curve({{-5, 5}, {-9, 5}}), false});
  layer.closed.push_back({closed_curve(square({20, 20}, 5)), true});
  layer.points.push_back({{30, 30}});
  const LayerRegion result = make_region(layer, {});
  CHECK(engine::area(result.region) == Approx(4.0));
  CHECK(result.open_contours == 2);
  CHECK(result.touch_contours == 1);
  CHECK(result.touch_points == 1);
  CHECK(result.closed_contours == 1);
}

TEST_CASE("flattening neither shrinks nor grows a curved contour") {
  engine::Layer layer;
  layer.plane = {0.1, 0.0, 0.2};
  layer.closed.push_back({parabola_lens()});
  // Archimedes: a parabola segment has 2/3 of its box; the piece's height is half its control point's.
  const double exact = 2.0 * (2.0 / 3.0) * 10.0 * 2.0;
  for (const double tolerance : {0.1, 0.01, 0.001}) {
    const double area = engine::area(make_region(layer, {tolerance, 0.0, 0.0}).region);
    // Balanced chords: the mean of the signed distance is near zero. Inscribed ones would lose two thirds of
    // tolerance times length, 22 mm.
    CHECK(std::abs(area - exact) < 0.001 * tolerance * 22.0);
  }
}

TEST_CASE("compensations grow every layer and shrink the first") {
  RegionOptions options;
  options.xy_compensation = 0.1;
  options.elephant_foot = 0.3;
  const std::vector<Loop> loops{square({0, 0}, 10), square({0, 0}, 4)};
  CHECK(engine::area(make_region(layer_of(1, 0.2, loops), options).region) ==
        Approx(10.2 * 10.2 - 3.8 * 3.8).epsilon(1e-6));
  CHECK(engine::area(make_region(layer_of(0, 0.2, loops), options).region) ==
        Approx(9.6 * 9.6 - 4.4 * 4.4).epsilon(1e-6));
}

TEST_CASE("offsets have the area that Steiner's formula gives") {
  const Region region{{square({3, 4}, 10), {}}};
  for (const double d : {0.1, 1.0, 2.5}) {
    CHECK(engine::area(offset(region, d, Join::kRound)) ==
          Approx(100.0 + 40.0 * d + std::numbers::pi * d * d).margin(0.002 * 2.0 * std::numbers::pi * d));
    CHECK(engine::area(offset(region, d, Join::kMiter)) == Approx((10 + 2 * d) * (10 + 2 * d)).epsilon(1e-6));
    CHECK(engine::area(offset(region, -d, Join::kRound)) ==
          Approx((10 - 2 * d) * (10 - 2 * d)).epsilon(1e-6));
  }
  CHECK(offset(region, -5.001, Join::kRound).empty());
}

TEST_CASE("opening takes away what is narrow and leaves the rest as it was") {
  // A square with a thin fin on its right.
  const Region finned = unite({{{square({0, 0}, 10), {}}}, {{rectangle(4, -0.2, 9, 0.2), {}}}});
  CHECK(engine::area(finned) == Approx(100.0 + 4.0 * 0.4).epsilon(1e-9));
  CHECK(engine::area(opened(finned, 0.3)) == Approx(100.0).margin(0.2));
  CHECK(engine::area(opened(finned, 0.1)) == Approx(101.6).epsilon(1e-6));
}

TEST_CASE("booleans agree with counting random points") {
  const unsigned seed = 20261;
  CAPTURE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0.0, 20.0);
  std::uniform_real_distribution<double> size(2.0, 8.0);
  for (int round = 0; round < 20; ++round) {
    const Region a{{circle({place(random), place(random)}, size(random), 37), {}}};
    const Region b{{square({place(random), place(random)}, size(random)), {}}};
    const auto in = [](const engine::Vector2& p, const Region& region) {
      bool inside = false;
      for (const engine::Polygon& polygon : region) {
        std::vector<Loop> loops{polygon.outer};
        loops.insert(loops.end(), polygon.holes.begin(), polygon.holes.end());
        inside = inside || inside_loops(p, loops);
      }
      return inside;
    };
    const Region both = intersect(a, b);
    const Region either = unite({a, b});
    const Region rest = subtract(a, b);
    int wrong = 0;
    for (int i = 0; i < 500; ++i) {
      const engine::Vector2 p(place(random), place(random));
      wrong += in(p, both) != (in(p, a) && in(p, b)) ? 1 : 0;
      wrong += in(p, either) != (in(p, a) || in(p, b)) ? 1 : 0;
      wrong += in(p, rest) != (in(p, a) && !in(p, b)) ? 1 : 0;
    }
    CHECK(wrong == 0);
  }
}
