#include "tests/reference/contour/contour_curve.h"

#include <catch2/catch.hpp>

using namespace lamina;
using reference::flatten_closed;
using reference::polyline_curve;

TEST_CASE("a closed curve's loop leaves out the repeated point", "[contours]") {
  const engine::PlanarCurve square = polyline_curve({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}});
  const engine::Loop loop = flatten_closed(square, 0.01);
  REQUIRE(loop.size() == 4);
  CHECK(engine::signed_area(loop) == Approx(4.0));
}

TEST_CASE("a polyline's curve runs through its points by chord length", "[contours]") {
  const engine::Polyline points{{0, 0}, {3, 0}, {3, 4}, {0, 4}};
  const engine::PlanarCurve curve = polyline_curve(points);
  CHECK(curve.degree == 1);
  CHECK((engine::evaluate(curve, 0.3) - points[1]).norm() < 1e-12);
  CHECK((engine::evaluate(curve, 0.7) - points[2]).norm() < 1e-12);
  CHECK((engine::evaluate(curve, 0.5) - engine::Vector2(3, 2)).norm() < 1e-12);
  const engine::Box2 box = engine::control_box(curve);
  CHECK(box.min() == engine::Vector2(0, 0));
  CHECK(box.max() == engine::Vector2(3, 4));
}
