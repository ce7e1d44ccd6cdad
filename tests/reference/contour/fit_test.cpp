#include "tests/reference/contour/fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "engine/geometry/bspline_basis.h"

namespace lamina::tests {
namespace {

using engine::Knots;
using engine::PlanarCurve;
using engine::Polyline;
using engine::Vector2;
using reference::BezierSegment;
using reference::FitResult;

constexpr unsigned kSeed = 153;

Polyline circle_points(double radius, int count) {
  Polyline points;
  for (int k = 0; k <= count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count;
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  points.back() = points.front();
  return points;
}

/// Corners of the cells that a wavy line runs through, as the tracer gives them.
Polyline staircase(double epsilon, std::size_t count) {
  Polyline points;
  for (std::size_t k = 0; k < count; ++k) {
    const double x = static_cast<double>(k) * epsilon;
    points.emplace_back(x, epsilon * std::floor((std::sin(x) + 0.3 * x) / epsilon));
  }
  return points;
}

std::vector<double> values_at(const PlanarCurve& curve, double t) {
  std::vector<double> all(curve.control_points.size(), 0.0);
  const std::size_t span = engine::find_span(curve.knots, curve.degree, t);
  const engine::BasisRow basis = engine::basis_functions(curve.knots, curve.degree, span, t);
  for (std::size_t r = 0; r < basis.size(); ++r)
    all[span - static_cast<std::size_t>(curve.degree) + r] = basis[r];
  return all;
}

double sum_of_squares(const PlanarCurve& curve, const Polyline& points,
                      const std::vector<double>& parameters) {
  double sum = 0.0;
  for (std::size_t r = 0; r < points.size(); ++r) {
    sum += (engine::evaluate(curve, parameters[r]) - points[r]).squaredNorm();
  }
  return sum;
}

}  // namespace

TEST_CASE("parameters follow the chord length", "[fit]") {
  const std::vector<double> parameters =
      reference::chord_length_parameters({{0, 0}, {3, 0}, {3, 4}, {3, 4}, {0, 0}});
  const std::vector<double> expected{0.0, 3.0 / 12.0, 7.0 / 12.0, 7.0 / 12.0, 1.0};
  REQUIRE(parameters.size() == expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) CHECK(parameters[k] == Approx(expected[k]).margin(1e-15));
}

TEST_CASE("segments divide the points end to end by halves", "[fit]") {
  const Polyline points = staircase(0.05, 400);
  const std::vector<double> parameters = reference::chord_length_parameters(points);
  for (const double tolerance : {0.5, 0.05, 0.005, 1e-6}) {
    const auto segments = reference::divide_by_bezier_fit(points, parameters, 2, tolerance);
    REQUIRE_FALSE(segments.empty());
    CHECK(segments.front().first == 0);
    CHECK(segments.back().last == points.size() - 1);
    for (std::size_t k = 0; k < segments.size(); ++k) {
      CHECK(segments[k].first < segments[k].last);
      if (k > 0) CHECK(segments[k].first == segments[k - 1].last);
    }
  }
}

TEST_CASE("a smaller tolerance divides further", "[fit]") {
  const Polyline points = staircase(0.05, 400);
  const std::vector<double> parameters = reference::chord_length_parameters(points);
  std::size_t before = 0;
  for (const double tolerance : {10.0, 0.5, 0.05, 0.005, 0.0005}) {
    const std::size_t count = reference::divide_by_bezier_fit(points, parameters, 2, tolerance).size();
    CHECK(count >= before);
    before = count;
  }
  CHECK(before > 1);
}

TEST_CASE("each segment's least-squares Bezier curve is within the tolerance, its parent's is not", "[fit]") {
  const Polyline points = staircase(0.05, 300);
  const std::vector<double> parameters = reference::chord_length_parameters(points);
  constexpr double kTolerance = 0.02;
  // Degree 2, ends fixed: one free control point b minimises sum |r - B1 b|^2, in closed form.
  const auto sum_on = [&](std::size_t first, std::size_t last) {
    const auto at = [&](std::size_t r) {
      return (parameters[r] - parameters[first]) / (parameters[last] - parameters[first]);
    };
    Vector2 numerator = Vector2::Zero();
    double denominator = 0.0;
    const auto rest = [&](std::size_t r) {
      const double t = at(r);
      return Vector2(points[r] - (1 - t) * (1 - t) * points[first] - t * t * points[last]);
    };
    for (std::size_t r = first + 1; r < last; ++r) {
      const double b1 = 2 * at(r) * (1 - at(r));
      numerator += b1 * rest(r);
      denominator += b1 * b1;
    }
    double sum = 0.0;
    for (std::size_t r = first + 1; r < last; ++r) {
      sum += (rest(r) - 2 * at(r) * (1 - at(r)) * numerator / denominator).squaredNorm();
    }
    return sum;
  };
  const auto segments = reference::divide_by_bezier_fit(points, parameters, 2, kTolerance);
  REQUIRE(segments.size() > 1);
  for (const BezierSegment segment : segments) {
    if (segment.last - segment.first < 3) continue;
    CHECK(sum_on(segment.first, segment.last) <= kTolerance * (1 + 1e-9));
  }
  CHECK(sum_on(0, points.size() - 1) > kTolerance);
}

TEST_CASE("a single segment has no inner knot", "[fit]") {
  const std::vector<double> parameters{0.0, 0.2, 0.4, 0.6, 0.8, 1.0};
  CHECK(reference::averaged_knots(parameters, {{0, 5}}, 3) == Knots{0, 0, 0, 0, 1, 1, 1, 1});
}

TEST_CASE("knots are averages of averages", "[fit]") {
  // Two segments of degree 1: two groups each, then groups of one. Segment one: 0, 1/8 | 2/8, 3/8, 4/8;
  // segment two alike from 4/8 on. The first average, 0.5/8, has no point between it and the end and is left
  // out.
  std::vector<double> parameters;
  for (int k = 0; k <= 8; ++k) parameters.push_back(k / 8.0);
  const Knots knots = reference::averaged_knots(parameters, {{0, 4}, {4, 8}}, 1);
  const Knots expected{0, 0, 3.0 / 8, 4.5 / 8, 7.0 / 8, 1, 1};
  REQUIRE(knots.size() == expected.size());
  for (std::size_t k = 0; k < knots.size(); ++k) CHECK(knots[k] == Approx(expected[k]).margin(1e-14));
}

TEST_CASE("every knot vector carries a solvable fit (Schoenberg and Whitney)", "[fit]") {
  std::mt19937 random(kSeed);
  CAPTURE(kSeed);
  std::uniform_int_distribution<std::size_t> length(1, 30);
  std::uniform_real_distribution<double> step(0.01, 1.0);
  for (int round = 0; round < 200; ++round) {
    std::vector<BezierSegment> segments;
    std::size_t last = 0;
    for (int k = 0; k < 1 + round % 12; ++k) {
      const std::size_t next = last + length(random);
      segments.push_back({last, next});
      last = next;
    }
    std::vector<double> parameters{0.0};
    for (std::size_t r = 0; r < last; ++r) parameters.push_back(parameters.back() + step(random));
    for (double& t : parameters) t /= parameters.back();
    parameters.back() = 1.0;
    for (int degree = 1; degree <= std::min<int>(4, static_cast<int>(last)); ++degree) {
      const auto p = static_cast<std::size_t>(degree);
      const Knots knots = reference::averaged_knots(parameters, segments, degree);
      CAPTURE(round, degree, last);
      REQUIRE(std::is_sorted(knots.begin(), knots.end()));
      for (std::size_t k = 0; k <= p; ++k) {
        CHECK(knots[k] == 0.0);
        CHECK(knots[knots.size() - 1 - k] == 1.0);
      }
      CHECK(knots[p + 1] > 0.0);
      CHECK(knots[knots.size() - p - 2] < 1.0);
      // A strictly rising choice of one parameter inside each support, greedily: if it fails none exists.
      const std::size_t count = knots.size() - p - 1;
      std::size_t used = 1;  // the first and the last control point are the first and the last point
      bool solvable = count <= parameters.size();
      for (std::size_t i = 1; i + 1 < count && solvable; ++i) {
        while (used + 1 < parameters.size() && parameters[used] <= knots[i]) ++used;
        solvable = used + 1 < parameters.size() && parameters[used] < knots[i + p + 1];
        ++used;
      }
      CHECK(solvable);
    }
  }
}

TEST_CASE("the residual of a least-squares curve is orthogonal to every free basis function", "[fit]") {
  const Polyline points = staircase(0.05, 200);
  const std::vector<double> parameters = reference::chord_length_parameters(points);
  for (const int degree : {1, 2, 3}) {
    const auto segments = reference::divide_by_bezier_fit(points, parameters, degree, 0.01);
    const Knots knots = reference::averaged_knots(parameters, segments, degree);
    const PlanarCurve curve = reference::least_squares_curve(points, parameters, knots, degree);
    REQUIRE(curve.control_points.size() > 4);
    CHECK(curve.control_points.front() == points.front());
    CHECK(curve.control_points.back() == points.back());
    std::vector<Vector2> products(curve.control_points.size(), Vector2::Zero());
    for (std::size_t r = 1; r + 1 < points.size(); ++r) {
      const Vector2 residual = points[r] - engine::evaluate(curve, parameters[r]);
      const std::vector<double> basis = values_at(curve, parameters[r]);
      for (std::size_t i = 0; i < basis.size(); ++i) products[i] += basis[i] * residual;
    }
    CAPTURE(degree);
    for (std::size_t i = 1; i + 1 < products.size(); ++i) CHECK(products[i].norm() < 1e-9);
  }
}

TEST_CASE("no small change of a control point improves a least-squares curve", "[fit]") {
  std::mt19937 random(kSeed);
  CAPTURE(kSeed);
  const Polyline points = staircase(0.05, 150);
  const std::vector<double> parameters = reference::chord_length_parameters(points);
  const Knots knots{0, 0, 0, 0.2, 0.4, 0.6, 0.8, 1, 1, 1};
  const PlanarCurve best = reference::least_squares_curve(points, parameters, knots, 2);
  const double least = sum_of_squares(best, points, parameters);
  std::normal_distribution<double> change(0.0, 0.01);
  for (int round = 0; round < 50; ++round) {
    PlanarCurve other = best;
    for (std::size_t i = 1; i + 1 < other.control_points.size(); ++i) {
      other.control_points[i] += Vector2(change(random), change(random));
    }
    CHECK(sum_of_squares(other, points, parameters) > least);
  }
}

TEST_CASE("a fitted curve is within epsilon of every point at its parameter", "[fit]") {
  for (const double epsilon : {0.1, 0.05, 0.01}) {
    for (const int degree : {1, 2, 3, 5}) {
      for (const Polyline& points : {staircase(epsilon, 500), circle_points(3.0, 700)}) {
        const FitResult fit = reference::fit_curve(points, {epsilon, degree});
        CAPTURE(epsilon, degree);
        CHECK(fit.within_tolerance);
        CHECK(fit.curve.degree == degree);
        CHECK(fit.curve.knots.size() ==
              fit.curve.control_points.size() + static_cast<std::size_t>(degree) + 1);
        CHECK(fit.greatest_distance <= epsilon);
        const std::vector<double> parameters = reference::chord_length_parameters(points);
        double greatest = 0.0;
        for (std::size_t r = 0; r < points.size(); ++r) {
          greatest = std::max(greatest, (engine::evaluate(fit.curve, parameters[r]) - points[r]).norm());
        }
        CHECK(greatest == Approx(fit.greatest_distance).margin(1e-12));
        CHECK(fit.curve.control_points.front() == points.front());
        CHECK(fit.curve.control_points.back() == points.back());
      }
    }
  }
}

TEST_CASE("points on a line give a line without inner knots", "[fit]") {
  Polyline points;
  for (int k = 0; k <= 100; ++k) points.emplace_back(0.1 * k, 0.05 * k);
  const FitResult fit = reference::fit_curve(points, {0.05, 2});
  CHECK(fit.curve.control_points.size() == 3);
  CHECK(fit.greatest_distance < 1e-10);
}

TEST_CASE("points on a circle give a circle of few control points", "[fit]") {
  const FitResult fit = reference::fit_curve(circle_points(3.0, 600), {0.05, 2});
  for (const Vector2& point : engine::flatten(fit.curve, 1e-4))
    CHECK(point.norm() == Approx(3.0).margin(0.06));
  CHECK(fit.curve.control_points.size() < 60);
}

TEST_CASE("few points lower the degree", "[fit]") {
  const FitResult two = reference::fit_curve({{0, 0}, {1, 0}}, {0.05, 3});
  CHECK(two.curve.degree == 1);
  CHECK(engine::length(engine::flatten(two.curve, 1e-3)) == Approx(1.0));
  const FitResult three = reference::fit_curve({{0, 0}, {1, 0}, {1, 1}}, {0.05, 3});
  CHECK(three.curve.degree == 2);
  CHECK(three.within_tolerance);
  CHECK(three.greatest_distance <= 0.05);
}

TEST_CASE("zigzags of a cell are fitted within epsilon or said not to be", "[fit]") {
  std::mt19937 random(kSeed);
  CAPTURE(kSeed);
  std::uniform_int_distribution<int> step(-1, 1);
  for (int round = 0; round < 50; ++round) {
    Polyline points{{0.0, 0.0}};
    for (int k = 0; k < 60; ++k) points.emplace_back(points.back() + Vector2(0.05, 0.05 * step(random)));
    const FitResult fit = reference::fit_curve(points, {0.05, 2});
    const std::vector<double> parameters = reference::chord_length_parameters(points);
    for (std::size_t r = 0; r < points.size(); ++r) {
      CHECK((engine::evaluate(fit.curve, parameters[r]) - points[r]).norm() <= 0.05 * (1 + 1e-9));
    }
  }
}

}  // namespace lamina::tests
