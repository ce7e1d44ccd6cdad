#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "engine/contour/fit/fit_pieces.h"
#include "engine/geometry/balanced_chords.h"
#include "tests/engine/fit/curve_distance.h"
#include "tests/engine/fit/node_shapes.h"

using namespace lamina::engine;
using namespace lamina::tests;
using std::numbers::pi;

namespace {

NodeChain without_tangents(NodeChain chain) {
  for (ContourNode& node : chain.nodes) node.tangent_in = node.tangent_out = Vector2::Zero();
  return chain;
}

NodeChain points(const Polyline& positions, bool closed) {
  NodeChain chain;
  chain.closed = closed;
  for (const Vector2& position : positions) {
    chain.nodes.emplace_back();
    chain.nodes.back().position = position;
  }
  return chain;
}

}  // namespace

TEST_CASE("no node, one node and nodes in one place give no pieces") {
  for (const bool closed : {false, true}) {
    CHECK(fit_pieces(points({}, closed), {}).curve.pieces.empty());
    CHECK(fit_pieces(points({{1, 2}}, closed), {}).curve.pieces.empty());
    CHECK(fit_pieces(points({{1, 2}, {1, 2}, {1, 2 + 1e-10}}, closed), {}).curve.pieces.empty());
  }
  CHECK(flatten_balanced(PieceCurve{}, 0.01).empty());
  CHECK(flatten(PieceCurve{}, 0.01).empty());
  CHECK(sample_evenly(PieceCurve{}, 0.01).empty());
  CHECK(bounds(PieceCurve{}).isEmpty());
}

TEST_CASE("two nodes without tangents are a line, with tangents askew a curve through both") {
  CHECK(letters(fit_pieces(points({{0, 0}, {3, 4}}, false), {}).curve) == "L");
  NodeChain chain = points({{0, 0}, {10, 0}}, false);
  chain.nodes[0].tangent_out = chain.nodes[0].tangent_in = Vector2(1, 1).normalized();
  chain.nodes[1].tangent_in = chain.nodes[1].tangent_out = Vector2(1, -0.5).normalized();
  const PieceCurve curve = fit_pieces(chain, {}).curve;
  REQUIRE(letters(curve) == "S");
  CHECK(start_point(curve.pieces[0]) == Vector2(0, 0));
  CHECK(end_point(curve.pieces[0]) == Vector2(10, 0));
  CHECK((start_tangent(curve.pieces[0]) - Vector2(1, 1).normalized()).norm() < 1e-12);
  CHECK((end_tangent(curve.pieces[0]) - Vector2(1, -0.5).normalized()).norm() < 1e-12);
}

TEST_CASE("repeated nodes change nothing") {
  const NodeChain chain = rounded_rectangle(40.0, 30.0, 5.0, 9);
  NodeChain doubled;
  doubled.closed = true;
  for (const ContourNode& node : chain.nodes) doubled.nodes.insert(doubled.nodes.end(), 3, node);
  doubled.nodes.push_back(chain.nodes.front());
  CHECK(letters(fit_pieces(doubled, {}).curve) == letters(fit_pieces(chain, {}).curve));
  CHECK(signed_area(fit_pieces(doubled, {}).curve) == signed_area(fit_pieces(chain, {}).curve));
}

TEST_CASE("collinear nodes, evenly spaced or not, are one line") {
  CHECK(letters(fit_pieces(NodePen({0, 0}, 0.4).line(50.0, 100).open(), {}).curve) == "L");
  CHECK(letters(fit_pieces(points({{0, 0}, {1e-6, 0}, {3, 0}, {3.5, 0}, {100, 0}}, false), {}).curve) == "L");
}

TEST_CASE("nodes without tangents: the shape comes from the positions") {
  PieceFitOptions options;
  options.tolerance = 0.01;
  const PieceFit fit = fit_pieces(without_tangents(nodes_on(ellipse(20.0, 10.0), 400, true)), options);
  CHECK(greatest_distance(dense_points(fit.curve, 500), dense_points(ellipse(20.0, 10.0), 20000)) < 0.012);
  CHECK(letters(fit_pieces(points({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, true), {}).curve) == "LLLL");
}

TEST_CASE("a stretch of unknown tangents inside known ones is bridged") {
  NodeChain chain = nodes_on(ellipse(20.0, 10.0), 400, true);
  for (std::size_t i = 100; i < 120; ++i) {
    chain.nodes[i].tangent_in = chain.nodes[i].tangent_out = Vector2::Zero();
    chain.nodes[i].exact = false;
  }
  const PieceFit fit = fit_pieces(chain, {});
  CHECK(greatest_distance(dense_points(fit.curve, 500), dense_points(ellipse(20.0, 10.0), 20000)) < 0.003);
}

TEST_CASE("tiny closed loops stay closed and where they are") {
  for (const double size : {1e-3, 1e-5, 1e-7}) {
    for (const std::size_t count : {std::size_t{2}, std::size_t{3}, std::size_t{4}, std::size_t{7}}) {
      const NodeChain chain = nodes_on(ellipse(size, 0.6 * size), count, true);
      for (const NodeChain& variant : {chain, without_tangents(chain)}) {
        const PieceCurve curve = fit_pieces(variant, {}).curve;
        CAPTURE(size, count, letters(curve));
        REQUIRE_FALSE(curve.pieces.empty());
        CHECK(greatest_gap(curve) == 0.0);
        const Box2 box = bounds(curve);
        CHECK(box.min().norm() < 10.0 * size);
        CHECK(box.max().norm() < 10.0 * size);
        CHECK(std::isfinite(signed_area(curve)));
        for (const Vector2& vertex : flatten_balanced(curve, 0.01)) CHECK(vertex.norm() < 10.0 * size);
      }
    }
  }
}

TEST_CASE("a lens of two arcs that meet in corners, and a hairpin") {
  const double angle = pi / 3;
  NodePen pen({0, 0}, angle);
  pen.arc(5.0, -2 * angle, 10).turn(-(pi - 2 * angle)).arc(5.0, -2 * angle, 10).turn(-(pi - 2 * angle));
  CHECK(letters(fit_pieces(pen.closed(), {}).curve) == "AA");
  CHECK(letters(fit_pieces(NodePen({0, 0}).line(5.0, 3).turn(pi).line(5.0, 3).closed(), {}).curve) == "LL");
}

TEST_CASE("a tangent that points backwards is not believed") {
  NodeChain chain = nodes_on(ellipse(20.0, 10.0), 400, true);
  chain.nodes[50].tangent_in = chain.nodes[50].tangent_out = -chain.nodes[50].tangent_in;
  const PieceFit fit = fit_pieces(chain, {});
  CHECK(greatest_distance(dense_points(fit.curve, 500), dense_points(ellipse(20.0, 10.0), 20000)) < 0.003);
}
