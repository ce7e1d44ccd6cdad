#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "engine/contour/fit/fit_pieces.h"
#include "tests/engine/fit/curve_distance.h"
#include "tests/engine/fit/node_shapes.h"

using namespace lamina::engine;
using namespace lamina::tests;
using std::numbers::pi;

TEST_CASE("a square with one segment a side is four lines and four exact corners") {
  NodePen pen({1.0, 2.0});
  for (int side = 0; side < 4; ++side) pen.line(20.0, 1).turn(pi / 2);
  const NodeChain chain = pen.closed();
  const PieceCurve curve = fit_pieces(chain, {}).curve;
  REQUIRE(letters(curve) == "LLLL");
  CHECK(curve.closed);
  for (std::size_t i = 0; i < 4; ++i) CHECK(start_point(curve.pieces[i]) == chain.nodes[i].position);
  CHECK(greatest_gap(curve) == 0.0);
  CHECK(signed_area(curve) == Approx(400.0).epsilon(1e-12));
  CHECK(length(curve) == Approx(80.0).epsilon(1e-12));
}

TEST_CASE("a square whose corners are flagged and whose sides have many nodes is the same four lines") {
  NodePen pen({0.0, 0.0}, 0.3);
  for (int side = 0; side < 4; ++side) pen.line(200.0, 37).turn(pi / 2);
  NodeChain chain = pen.closed();
  for (ContourNode& node : chain.nodes) node.tangent_in = node.tangent_out = Vector2::Zero();
  for (std::size_t i = 0; i < chain.nodes.size(); i += 37) chain.nodes[i].corner = true;
  // It may begin anywhere.
  std::rotate(chain.nodes.begin(), chain.nodes.begin() + 11, chain.nodes.end());
  const PieceCurve curve = fit_pieces(chain, {}).curve;
  CHECK(letters(curve) == "LLLL");
  CHECK(signed_area(curve) == Approx(40000.0).epsilon(1e-12));
}

TEST_CASE("a circle is two arcs at any size, place, direction and number of nodes") {
  for (const double radius : {0.05, 1.0, 10.0, 5000.0}) {
    for (const std::size_t count : {std::size_t{5}, std::size_t{16}, std::size_t{301}, std::size_t{2000}}) {
      for (const bool clockwise : {false, true}) {
        const Vector2 centre(123.456, -77.0);
        NodeChain chain = placed(nodes_on(ellipse(radius, radius), count, true), 0.7, 1.0, centre);
        if (clockwise) chain = reversed(chain);
        const PieceCurve curve = fit_pieces(chain, {}).curve;
        CAPTURE(radius, count, clockwise);
        REQUIRE(letters(curve) == "AA");
        for (const CurvePiece& piece : curve.pieces) {
          const auto& arc = std::get<CircularArc>(piece);
          CHECK((arc.centre - centre).norm() < 1e-8 * std::max(1.0, radius));
          CHECK(std::abs(arc.radius() - radius) < 1e-8 * std::max(1.0, radius));
        }
        CHECK(greatest_gap(curve) == 0.0);
        CHECK(signed_area(curve) == Approx((clockwise ? -1.0 : 1.0) * pi * radius * radius).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("a rounded rectangle is four lines and four arcs, wherever its chain begins") {
  const NodeChain chain = rounded_rectangle(40.0, 30.0, 5.0, 9);
  const double area = 40.0 * 30.0 - (4.0 - pi) * 25.0;
  for (std::size_t start = 0; start < chain.nodes.size(); ++start) {
    NodeChain turned = chain;
    std::rotate(turned.nodes.begin(), turned.nodes.begin() + static_cast<std::ptrdiff_t>(start),
                turned.nodes.end());
    for (const bool backwards : {false, true}) {
      const PieceCurve curve = fit_pieces(backwards ? reversed(turned) : turned, {}).curve;
      CAPTURE(start, backwards, letters(curve));
      CHECK((letters(curve) == "LALALALA" || letters(curve) == "ALALALAL"));
      CHECK(signed_area(curve) == Approx(backwards ? -area : area).epsilon(1e-10));
      CHECK(greatest_kink(curve) < 1e-7);
    }
  }
}

TEST_CASE("lines and arcs keep their joints: S-curves, slots, arcs of two radii, a three-quarter circle") {
  const auto letters_of = [](const NodeChain& chain) { return letters(fit_pieces(chain, {}).curve); };
  CHECK(letters_of(NodePen({0, 0}).arc(5.0, 1.0, 8).arc(5.0, -1.0, 8).open()) == "AA");
  CHECK(letters_of(NodePen({0, 0}).arc(5.0, 1.0, 8).arc(8.0, 1.0, 8).open()) == "AA");
  CHECK(letters_of(NodePen({0, 0}).line(3.0, 4).arc(50.0, 0.3, 6).line(2.0, 3).open()) == "LAL");
  CHECK(letters_of(NodePen({0, 0}).line(30.0).arc(4.0, pi, 12).line(30.0).arc(4.0, pi, 12).closed()) ==
        "ALAL");
  CHECK(letters_of(NodePen({0, 0}).arc(4.0, 1.2 * pi, 20).open()) == "A");
  CHECK(letters_of(NodePen({0, 0}).arc(4.0, 1.7 * pi, 20).open()) == "AA");
  CHECK(letters_of(NodePen({0, 0}).arc(2.0, pi / 2, 3).turn(1.0).line(3.0).open()) == "AL");
}

TEST_CASE("what is no circle is not made of arcs") {
  for (const std::size_t count : {std::size_t{40}, std::size_t{200}, std::size_t{1000}, std::size_t{5000}}) {
    CAPTURE(count);
    CHECK(
        letters(fit_pieces(nodes_on(spiral(2.0, 1.0, 2.0), count, false), {}).curve).find_first_not_of('S') ==
        std::string::npos);
    CHECK(letters(fit_pieces(nodes_on(spiral(20.0, 0.01, 2.0), count, false), {}).curve)
              .find_first_not_of('S') == std::string::npos);
    for (const double b : {10.0, 19.0, 19.99, 19.9999}) {
      CAPTURE(b);
      CHECK(letters(fit_pieces(nodes_on(ellipse(20.0, b), count, true), {}).curve).find_first_not_of('S') ==
            std::string::npos);
    }
    CHECK(letters(fit_pieces(nodes_on(flower(20.0, 2.0, 5), count, true), {}).curve).find_first_not_of('S') ==
          std::string::npos);
  }
}

TEST_CASE(
    "an ellipse within the recognition tolerance of a circle may be arcs, and then keeps that tolerance") {
  const NodeChain chain = nodes_on(ellipse(20.0, 20.0 + 4e-7), 400, true);
  const PieceCurve curve = fit_pieces(chain, {}).curve;
  CHECK(letters(curve) == "AA");
  for (const ContourNode& node : chain.nodes) {
    const auto& arc = std::get<CircularArc>(curve.pieces[0]);
    CHECK(std::abs((node.position - arc.centre).norm() - arc.radius()) <= 5e-7);
  }
}

TEST_CASE("recognised pieces lie on the true curve though the nodes carry their allowance of error") {
  NodeChain chain = rounded_rectangle(40.0, 30.0, 5.0, 20);
  unsigned state = 12345;
  for (ContourNode& node : chain.nodes) {
    const auto next = [&state] {
      state = state * 1664525u + 1013904223u;
      return (static_cast<double>(state >> 8) / 16777216.0 - 0.5) * 2e-9;
    };
    node.position += Vector2(next(), next());
  }
  const PieceCurve curve = fit_pieces(chain, {}).curve;
  CHECK(letters(curve) == "ALALALAL");
  const PieceCurve exact = fit_pieces(rounded_rectangle(40.0, 30.0, 5.0, 20), {}).curve;
  const Polyline points = dense_points(curve, 100);
  CHECK(greatest_distance(points, dense_points(exact, 2000)) < 1e-6);
}

TEST_CASE("a smooth blend between two lines stays a spline and the lines stay lines") {
  // A cubic Bezier that leaves and meets the lines with their direction and without curvature.
  PlanarCurve blend;
  blend.degree = 5;
  blend.knots = {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1};
  blend.control_points = {{10, 0}, {12, 0}, {14, 0}, {16, 2}, {16, 4}, {16, 6}};
  NodeChain chain = NodePen({0, 0}).line(10.0, 5).open();
  const NodeChain middle = nodes_on(spline(blend), 30, false);
  chain.nodes.insert(chain.nodes.end(), middle.nodes.begin() + 1, middle.nodes.end());
  const NodeChain end = NodePen({16, 6}, pi / 2).line(8.0, 5).open();
  chain.nodes.insert(chain.nodes.end(), end.nodes.begin() + 1, end.nodes.end());
  const PieceCurve curve = fit_pieces(chain, {}).curve;
  CHECK(letters(curve) == "LSL");
  CHECK(greatest_kink(curve) < 1e-5);
  CHECK(greatest_gap(curve) == 0.0);
}
