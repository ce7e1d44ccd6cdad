#include "engine/geometry/planar_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "engine/geometry/piece_curve.h"

namespace lamina::tests {
namespace {

using engine::PlanarCurve;
using engine::Polyline;
using engine::Vector2;

constexpr unsigned kSeed = 20181;

/// A clamped curve with random control points and uneven, partly repeated knots.
PlanarCurve random_curve(int degree, std::mt19937& random) {
  std::uniform_real_distribution<double> place(-10.0, 10.0);
  PlanarCurve curve;
  curve.degree = degree;
  curve.knots.assign(static_cast<std::size_t>(degree) + 1, 0.0);
  double knot = 0.0;
  for (int k = 0; k < 6; ++k) {
    if (k % 3 != 2 || degree == 1) knot += 0.1 + 0.05 * (place(random) + 10.0);
    curve.knots.push_back(knot);
  }
  curve.knots.insert(curve.knots.end(), static_cast<std::size_t>(degree) + 1, knot + 0.5);
  const std::size_t count = curve.knots.size() - static_cast<std::size_t>(degree) - 1;
  for (std::size_t k = 0; k < count; ++k) curve.control_points.emplace_back(place(random), place(random));
  return curve;
}

double distance_to_chain(const Polyline& chain, const Vector2& point) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const Vector2 side = chain[i] - chain[i - 1];
    const double squared = side.squaredNorm();
    const double t = squared > 0.0 ? std::clamp((point - chain[i - 1]).dot(side) / squared, 0.0, 1.0) : 0.0;
    least = std::min(least, (point - chain[i - 1] - t * side).norm());
  }
  return least;
}

Polyline dense_points(const PlanarCurve& curve, int count) {
  Polyline points;
  const double first = curve.first_parameter();
  const double last = curve.last_parameter();
  for (int k = 0; k <= count; ++k)
    points.push_back(engine::evaluate(curve, first + (last - first) * k / count));
  return points;
}

}  // namespace

TEST_CASE("a curve begins at its first and ends at its last control point", "[planar-curve]") {
  std::mt19937 random(kSeed);
  CAPTURE(kSeed);
  for (int degree = 1; degree <= 5; ++degree) {
    const PlanarCurve curve = random_curve(degree, random);
    CHECK((engine::evaluate(curve, curve.first_parameter()) - curve.control_points.front()).norm() < 1e-12);
    CHECK((engine::evaluate(curve, curve.last_parameter()) - curve.control_points.back()).norm() < 1e-12);
  }
}

TEST_CASE("the derivative of a curve agrees with central differences", "[planar-curve]") {
  std::mt19937 random(kSeed);
  CAPTURE(kSeed);
  for (int degree = 1; degree <= 4; ++degree) {
    const PlanarCurve curve = random_curve(degree, random);
    const std::vector<double> breaks = engine::break_points(curve.knots, degree);
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      const double t = breaks[i] + 0.37 * (breaks[i + 1] - breaks[i]);
      const double step = 1e-5 * (breaks[i + 1] - breaks[i]);
      const Vector2 difference =
          (engine::evaluate(curve, t + step) - engine::evaluate(curve, t - step)) / (2 * step);
      CHECK((engine::evaluate_derivative(curve, t) - difference).norm() <= 1e-5 * (1.0 + difference.norm()));
    }
  }
}

TEST_CASE("no point of a curve is farther from its chain than the tolerance", "[planar-curve]") {
  std::mt19937 random(kSeed);
  CAPTURE(kSeed);
  for (int degree = 1; degree <= 5; ++degree) {
    const PlanarCurve curve = random_curve(degree, random);
    const Polyline points = dense_points(curve, 1500);
    for (const double tolerance : {1.0, 0.1, 0.01}) {
      const Polyline chain = engine::flatten(curve, tolerance);
      double greatest = 0.0;
      for (const Vector2& point : points) greatest = std::max(greatest, distance_to_chain(chain, point));
      CAPTURE(degree, tolerance, chain.size());
      CHECK(greatest <= tolerance * (1.0 + 1e-9));
      CHECK((chain.front() - curve.control_points.front()).norm() < 1e-12);
      CHECK((chain.back() - curve.control_points.back()).norm() < 1e-12);
    }
  }
}

TEST_CASE("the number of chords follows the square root of the tolerance", "[planar-curve]") {
  // A parabola's second derivative is constant: h = sqrt(8 tolerance / |C''|) exactly. C = (t, t^2), C'' =
  // (0, 2).
  PlanarCurve parabola;
  parabola.degree = 2;
  parabola.knots = {0, 0, 0, 1, 1, 1};
  parabola.control_points = {{0, 0}, {0.5, 0}, {1, 1}};
  for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
    const double chords = std::ceil(std::sqrt(2.0 / (8.0 * tolerance)));
    CHECK(static_cast<double>(engine::flatten(parabola, tolerance).size()) == chords + 1.0);
  }
}

TEST_CASE("a straight curve flattens to its ends", "[planar-curve]") {
  PlanarCurve line;
  line.degree = 3;
  line.knots = {0, 0, 0, 0, 1, 1, 1, 1};
  line.control_points = {{0, 0}, {1, 2}, {2, 4}, {3, 6}};
  CHECK(engine::flatten(line, 1e-6).size() == 2);
}

TEST_CASE("even samples are evenly spaced along the arc", "[planar-curve]") {
  std::mt19937 random(kSeed);
  CAPTURE(kSeed);
  for (int degree = 1; degree <= 3; ++degree) {
    const PlanarCurve curve = random_curve(degree, random);
    const Polyline dense = dense_points(curve, 200000);
    const double total = engine::length(dense);
    const double step = 0.3;
    const Polyline samples = engine::sample_evenly(engine::PieceCurve{{curve}, false}, step);
    CAPTURE(degree, total);
    const double intervals = std::ceil(total / step);
    REQUIRE(static_cast<double>(samples.size()) == intervals + 1.0);
    CHECK((samples.front() - dense.front()).norm() < 1e-12);
    CHECK((samples.back() - dense.back()).norm() < 1e-9);
    // Walk the dense chain: sample k lies at the arc length k * total / intervals.
    double walked = 0.0;
    std::size_t next = 1;
    for (std::size_t i = 1; i < dense.size() && next + 1 < samples.size(); ++i) {
      walked += (dense[i] - dense[i - 1]).norm();
      if (walked < static_cast<double>(next) * total / intervals) continue;
      CHECK((dense[i] - samples[next]).norm() <= 0.01 * step);
      ++next;
    }
    CHECK(next + 1 == samples.size());
  }
}

}  // namespace lamina::tests
