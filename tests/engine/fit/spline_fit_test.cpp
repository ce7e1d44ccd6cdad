#include "engine/contour/fit/spline_fit.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "engine/contour/fit/fit_pieces.h"
#include "tests/engine/fit/curve_distance.h"
#include "tests/engine/fit/node_shapes.h"

using namespace lamina::engine;
using namespace lamina::tests;

namespace {

/// Both ways, by dense points: the sagitta of so short chords does not count, and fewer points will do to
/// look from.
double deviation(const PieceCurve& curve, const ParametricCurve& truth, std::size_t count = 20000) {
  const Polyline fitted = dense_points(curve, count / curve.pieces.size());
  const Polyline exact = dense_points(truth, count);
  return std::max(greatest_distance(every(fitted, count / 500 + 1), exact),
                  greatest_distance(every(exact, count / 500 + 1), fitted));
}

std::size_t controls(const NodeChain& chain, const PieceFitOptions& options) {
  return control_count(fit_pieces(chain, options).curve);
}

}  // namespace

TEST_CASE("splines keep the tolerance between the nodes too, join exactly and smoothly") {
  const auto [truth, closed, count] = GENERATE(table<ParametricCurve, bool, std::size_t>({
      {ellipse(20.0, 10.0), true, 600},
      {ellipse(20.0, 1.0), true, 1500},
      {spiral(2.0, 1.0, 3.0), false, 1000},
      {flower(20.0, 3.0, 7), true, 1500},
      {flower(20.0, 0.5, 40), true, 4000},
  }));
  for (const double tolerance : {0.02, 0.002, 0.0002}) {
    PieceFitOptions options;
    options.tolerance = tolerance;
    const PieceFit fit = fit_pieces(nodes_on(truth, count, closed), options);
    CAPTURE(tolerance, letters(fit.curve), control_count(fit.curve));
    CHECK(fit.greatest_distance <= tolerance);
    CHECK(deviation(fit.curve, truth, 50000) <= 1.04 * tolerance);
    CHECK(greatest_gap(fit.curve) == 0.0);
    CHECK(greatest_kink(fit.curve) < 1e-9);
    CHECK(control_count(fit.curve) < count / 4);
  }
}

TEST_CASE(
    "random splines are met within the tolerance and with a number of control points that is near theirs") {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const int degree = 2 + static_cast<int>(seed % 4);
    const PlanarCurve truth =
        random_spline(degree, static_cast<std::size_t>(degree) + 1 + seed % 9, 7000 + seed);
    PieceFitOptions options;
    options.tolerance = 0.005;
    const PieceFit fit = fit_pieces(nodes_on(spline(truth), 400, false), options);
    CAPTURE(seed, degree, truth.control_points.size(), letters(fit.curve), control_count(fit.curve));
    CHECK(deviation(fit.curve, spline(truth)) <= 1.01 * options.tolerance);
    // Their knots and parametrisation are unknown to the fit; those of degree 2 have jumps of curvature at
    // every knot.
    const double allowed = degree == 2 ? 3.0 : 2.0;
    CHECK(static_cast<double>(control_count(fit.curve)) <=
          allowed * static_cast<double>(truth.control_points.size()));
  }
}

TEST_CASE("a single Bezier segment is recovered: its degree and its control points") {
  for (int degree = 2; degree <= 3; ++degree) {
    PlanarCurve truth;
    truth.degree = degree;
    truth.knots.assign(static_cast<std::size_t>(degree) + 1, 0.0);
    truth.knots.insert(truth.knots.end(), static_cast<std::size_t>(degree) + 1, 1.0);
    const Polyline points{{0, 0}, {6, 9}, {17, 8}, {24, -3}};
    truth.control_points.assign(points.begin(), points.begin() + degree + 1);
    PieceFitOptions options;
    options.tolerance = 1e-4;
    const PieceFit fit = fit_pieces(nodes_on(spline(truth), 300, false), options);
    CAPTURE(degree, letters(fit.curve), control_count(fit.curve));
    REQUIRE(letters(fit.curve) == "S");
    const auto& curve = std::get<PlanarCurve>(fit.curve.pieces[0]);
    REQUIRE(curve.degree == degree);
    REQUIRE(curve.control_points.size() == truth.control_points.size());
    for (std::size_t i = 0; i < points.size() && i < curve.control_points.size(); ++i) {
      CHECK((curve.control_points[i] - truth.control_points[i]).norm() < 0.1);
    }
  }
}

TEST_CASE("one control point fewer would break the tolerance") {
  // A cubic whose third derivative does not vanish is no parabola; its four control points are the minimum.
  PlanarCurve truth;
  truth.degree = 3;
  truth.knots = {0, 0, 0, 0, 1, 1, 1, 1};
  truth.control_points = {{0, 0}, {5, 10}, {15, -10}, {20, 0}};
  PieceFitOptions options;
  options.tolerance = 0.001;
  CHECK(controls(nodes_on(spline(truth), 200, false), options) == 4);
  // An S cannot be one parabola at any tolerance below its height.
  options.tolerance = 0.5;
  CHECK(controls(nodes_on(spline(truth), 200, false), options) == 4);
}

TEST_CASE("fewer control points at a wider tolerance, and few at all") {
  std::size_t before = 1000;
  for (const double tolerance : {1e-4, 1e-3, 1e-2, 1e-1}) {
    PieceFitOptions options;
    options.tolerance = tolerance;
    const std::size_t count = controls(nodes_on(ellipse(20.0, 10.0), 2000, true), options);
    CAPTURE(tolerance, count);
    CHECK(count <= before + 3);  // a wider one may happen to be met by the narrower one's optimum only
    before = count;
  }
  CHECK(before <= 12);
}

TEST_CASE("the degrees that are allowed are the ones that are used") {
  for (int degree = 2; degree <= 5; ++degree) {
    PieceFitOptions options;
    options.least_degree = options.greatest_degree = degree;
    const PieceFit fit = fit_pieces(nodes_on(ellipse(20.0, 10.0), 400, true), options);
    CHECK(deviation(fit.curve, ellipse(20.0, 10.0)) <= 1.01 * options.tolerance);
    for (const CurvePiece& piece : fit.curve.pieces) CHECK(std::get<PlanarCurve>(piece).degree == degree);
  }
}

TEST_CASE("the fit does not depend on where, how large and which way round") {
  const NodeChain chain = nodes_on(spiral(3.0, 1.0, 1.5), 500, false);
  PieceFitOptions options;
  options.tolerance = 0.004;
  const std::size_t count = controls(chain, options);
  CHECK(controls(placed(chain, 1.1, 1.0, {0, 0}), options) == count);
  CHECK(controls(placed(chain, 0.0, 1.0, {250.0, -130.0}), options) == count);
  PieceFitOptions scaled = options;
  scaled.tolerance *= 8.0;
  scaled.recognition_tolerance *= 8.0;
  CHECK(controls(placed(chain, 0.0, 8.0, {0, 0}), scaled) == count);
  const std::size_t backwards = controls(reversed(chain), options);
  CHECK(backwards <= count + 2);
  CHECK(count <= backwards + 2);
  const PieceFit fit = fit_pieces(reversed(chain), options);
  CHECK(greatest_distance(dense_points(fit.curve, 500), dense_points(spiral(3.0, 1.0, 1.5), 20000)) <=
        1.01 * 0.004);
}

TEST_CASE("few nodes on a curve: the tangents carry the shape between them") {
  // Twelve nodes a turn: the chords are off by 0.3 mm, the cubics by a micrometre or so.
  const ParametricCurve truth = ellipse(12.0, 9.0);
  PieceFitOptions options;
  options.tolerance = 0.001;
  const PieceFit fit = fit_pieces(nodes_on(truth, 24, true), options);
  CHECK(deviation(fit.curve, truth) < 0.003);
}
