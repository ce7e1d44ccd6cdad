#include "engine/geometry/piece_curve.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "tests/engine/fit/curve_distance.h"
#include "tests/engine/fit/node_shapes.h"

using namespace lamina::engine;
using namespace lamina::tests;
using std::numbers::pi;

namespace {

/// A half disc with a parabola as lid: up along the arc, back along y = 2 - x^2 / 2, a quadratic Bezier.
PieceCurve half_disc_and_parabola() {
  PlanarCurve lid;
  lid.degree = 2;
  lid.knots = {0, 0, 0, 1, 1, 1};
  lid.control_points = {{2, 0}, {0, 4}, {-2, 0}};
  return {{CircularArc{{-2, 0}, {2, 0}, {0, 0}, pi}, lid}, true};
}

}  // namespace

TEST_CASE("area, length, bounds and points by closed form") {
  const PieceCurve curve = half_disc_and_parabola();
  CHECK(signed_area(curve) == Approx(2 * pi + 16.0 / 3.0).epsilon(1e-13));  // half disc, and 2/3 of 4 x 2
  // Parabola y = 2 - x^2 / 2 over [-2, 2]: 2 sqrt(5) + asinh(2).
  CHECK(length(curve) == Approx(2 * pi + 2 * std::sqrt(5.0) + std::asinh(2.0)).epsilon(1e-9));
  const Box2 box = bounds(curve);
  CHECK(box.min().x() == Approx(-2.0));
  CHECK(box.min().y() == Approx(-2.0));
  CHECK(box.max().y() >= 2.0);
  CHECK((point_on(curve, 0.5) - Vector2(0, -2)).norm() < 1e-12);
  CHECK((point_on(curve, 1.5) - Vector2(0, 2)).norm() < 1e-12);
  CHECK(point_on(curve, 2.0) == Vector2(-2, 0));
  CHECK(point_on(curve, 1.0) == Vector2(2, 0));
}

TEST_CASE("area far from the origin loses no digits that count") {
  PieceCurve curve = half_disc_and_parabola();
  const Vector2 shift(300.0, -200.0);
  auto& arc = std::get<CircularArc>(curve.pieces[0]);
  arc.start += shift;
  arc.end += shift;
  arc.centre += shift;
  for (Vector2& point : std::get<PlanarCurve>(curve.pieces[1]).control_points) point += shift;
  CHECK(signed_area(curve) == Approx(2 * pi + 16.0 / 3.0).epsilon(1e-10));
}

TEST_CASE("the box of an arc is tight in every quadrant") {
  for (int k = 0; k < 24; ++k) {
    const double begin = k * pi / 12 + 0.01;
    for (const double sweep : {0.4, -0.4, 2.0, -4.0, 6.2}) {
      const auto on = [](double angle) { return Vector2(3 + 2 * std::cos(angle), 1 + 2 * std::sin(angle)); };
      const CurvePiece arc = CircularArc{on(begin), on(begin + sweep), {3, 1}, sweep};
      Box2 expected;
      for (int j = 0; j <= 4000; ++j) expected.extend(on(begin + sweep * j / 4000));
      const Box2 box = bounds(arc);
      CHECK((box.min() - expected.min()).norm() < 1e-5);
      CHECK((box.max() - expected.max()).norm() < 1e-5);
    }
  }
}

TEST_CASE("flattened chains keep the tolerance and the ends") {
  const PieceCurve curve = half_disc_and_parabola();
  const Polyline dense = dense_points(curve, 20000);
  for (const double tolerance : {0.1, 0.001}) {
    Polyline chain = flatten(curve, tolerance);
    CHECK(chain.front() == Vector2(-2, 0));
    CHECK((chain.back() - chain.front()).norm() > tolerance);
    chain.push_back(chain.front());
    CHECK(greatest_distance(dense, chain) <= tolerance);
    CHECK(greatest_distance(chain, dense) < 1e-6);
  }
}

TEST_CASE("evenly sampled points lie on the curve at equal steps along it") {
  const PieceCurve curve = half_disc_and_parabola();
  const Polyline points = sample_evenly(curve, 0.01);
  CHECK(points.size() == static_cast<std::size_t>(std::ceil(length(curve) / 0.01)));
  CHECK(greatest_distance(points, dense_points(curve, 20000)) < 1e-6);
  const double step = length(curve) / static_cast<double>(points.size());
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double chord = (points[i] - points[i - 1]).norm();
    // The corner cuts one chord short.
    if ((points[i] - Vector2(2, 0)).norm() > 0.02) CHECK(chord == Approx(step).epsilon(1e-3));
  }
}
