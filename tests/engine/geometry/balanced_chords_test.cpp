#include "engine/geometry/balanced_chords.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "engine/contour/fit/fit_pieces.h"
#include "tests/engine/fit/curve_distance.h"
#include "tests/engine/fit/node_shapes.h"

using namespace lamina::engine;
using namespace lamina::tests;
using std::numbers::pi;

namespace {

struct Balance {
  double greatest = 0.0;  ///< between chain and curve, either way, mm
  double mean = 0.0;      ///< signed area between them by length, mm
};

/// Of a closed curve, by dense points and the shoelace formula.
Balance balance_of(const PieceCurve& curve, const Polyline& vertices) {
  const Polyline dense = dense_points(curve, 8000 / curve.pieces.size());
  Polyline chain = vertices;
  if (curve.closed) chain.push_back(chain.front());
  Polyline on_chain;
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    for (int k = 0; k < 8; ++k) on_chain.push_back(chain[i] + k / 8.0 * (chain[i + 1] - chain[i]));
  }
  return {std::max(greatest_distance(dense, chain), greatest_distance(on_chain, dense)),
          (signed_area(vertices) - signed_area(dense)) / length(dense)};
}

PieceCurve circle(double radius, bool clockwise) {
  const NodeChain chain = nodes_on(ellipse(radius, radius), 100, true);
  return fit_pieces(clockwise ? reversed(chain) : chain, {}).curve;
}

}  // namespace

TEST_CASE("the polygon of a circle has the circle's area") {
  for (const bool clockwise : {false, true}) {
    for (const double tolerance : {0.2, 0.05, 0.005}) {
      const PieceCurve curve = circle(10.0, clockwise);
      const double area = pi * 100.0;
      const Polyline inscribed = flatten(curve, tolerance);
      const Polyline balanced = flatten_balanced(curve, tolerance);
      const double inscribed_error = std::abs(std::abs(signed_area(inscribed)) - area) / area;
      const double balanced_error = std::abs(std::abs(signed_area(balanced)) - area) / area;
      CAPTURE(clockwise, tolerance, inscribed.size(), balanced.size(), inscribed_error, balanced_error);
      CHECK(balanced_error < inscribed_error / 1000.0);
      CHECK(balanced.size() < inscribed.size());
      for (const Vector2& vertex : balanced) {
        CHECK(vertex.norm() > 10.0);
        CHECK(vertex.norm() <= 10.0 + tolerance);
      }
    }
  }
}

TEST_CASE("chords stay within the tolerance of the curve and have the mean error zero") {
  const auto [name, chain] = GENERATE(table<std::string, NodeChain>({
      {"ellipse", nodes_on(ellipse(20.0, 10.0), 800, true)},
      {"thin ellipse", nodes_on(ellipse(20.0, 1.0), 2000, true)},
      {"flower", nodes_on(flower(20.0, 3.0, 7), 1500, true)},
      {"frequent flower", nodes_on(flower(20.0, 0.5, 40), 4000, true)},
      {"rounded rectangle", rounded_rectangle(40.0, 30.0, 5.0, 12)},
      {"slot", NodePen({0, 0}).line(30.0).arc(4.0, pi, 12).line(30.0).arc(4.0, pi, 12).closed()},
      {"half disc", NodePen({0, 0}).line(10.0).turn(pi / 2).arc(5.0, pi, 20).turn(pi / 2).closed()},
      {"clockwise flower", reversed(nodes_on(flower(20.0, 3.0, 7), 1500, true))},
  }));
  PieceFitOptions options;
  options.tolerance = 1e-4;
  const PieceCurve curve = fit_pieces(chain, options).curve;
  for (const double tolerance : {0.1, 0.02, 0.004}) {
    const Balance balance = balance_of(curve, flatten_balanced(curve, tolerance));
    CAPTURE(name, tolerance, balance.greatest, balance.mean);
    CHECK(balance.greatest <= tolerance);
    CHECK(std::abs(balance.mean) <= 0.02 * tolerance);
  }
}

TEST_CASE("a hole in a plate is as wide as before, and the plate as large") {
  const PieceCurve plate = fit_pieces(rounded_rectangle(40.0, 30.0, 5.0, 12), {}).curve;
  const PieceCurve hole = circle(6.0, true);
  const double area = signed_area(plate) + signed_area(hole);
  const double flattened =
      signed_area(flatten_balanced(plate, 0.02)) + signed_area(flatten_balanced(hole, 0.02));
  CHECK(flattened == Approx(area).epsilon(1e-6));
}

TEST_CASE("corners, ends and lines are kept exactly") {
  const NodeChain chain =
      NodePen({1, 1}).line(10.0).arc(4.0, 1.0, 8).turn(1.2).arc(7.0, -0.8, 8).line(3.0).open();
  const PieceCurve curve = fit_pieces(chain, {}).curve;
  REQUIRE(letters(curve) == "LAAL");
  const Polyline points = flatten_balanced(curve, 0.01);
  CHECK(points.front() == start_point(curve.pieces.front()));
  CHECK(points.back() == end_point(curve.pieces.back()));
  for (const CurvePiece& piece : curve.pieces) {
    CHECK(std::find(points.begin(), points.end(), start_point(piece)) != points.end());
  }
  const Polyline square = flatten_balanced(fit_pieces(NodePen({0, 0})
                                                          .line(5, 3)
                                                          .turn(pi / 2)
                                                          .line(5, 3)
                                                          .turn(pi / 2)
                                                          .line(5, 3)
                                                          .turn(pi / 2)
                                                          .line(5, 3)
                                                          .turn(pi / 2)
                                                          .closed(),
                                                      {})
                                               .curve,
                                           0.01);
  CHECK(square.size() == 4);
}

TEST_CASE("a run between two kept ends has the mean error zero, whatever its length") {
  for (const double angle : {0.05, 0.1, 0.2, 0.5, 1.0, 3.0}) {
    const NodeChain chain = NodePen({0, 0}).arc(10.0, angle, 20).open();
    const PieceCurve curve = fit_pieces(chain, {}).curve;
    const double tolerance = 0.02;
    const Polyline points = flatten_balanced(curve, tolerance);
    const Polyline dense = dense_points(curve, 40000);
    // Both areas are closed by the same chord.
    const double mean = (signed_area(points) - signed_area(dense)) / length(dense);
    CAPTURE(angle, points.size(), mean);
    CHECK(std::abs(mean) <= 0.02 * tolerance);
    CHECK(greatest_distance(dense, points) <= tolerance);
    CHECK(greatest_distance(points, dense) <= tolerance);
  }
}
