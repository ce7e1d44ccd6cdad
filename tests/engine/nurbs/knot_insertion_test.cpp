#include "engine/nurbs/knot_insertion.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "tests/support/random_nurbs.h"

namespace lamina::tests {
namespace {

using engine::NurbsCurve;
using engine::NurbsSurface;

constexpr double kSame = 1e-10;

void check_same_points(const NurbsCurve& a, const NurbsCurve& b) {
  REQUIRE(a.first_parameter() == b.first_parameter());
  REQUIRE(a.last_parameter() == b.last_parameter());
  for (int k = 0; k <= 200; ++k) {
    const double t = a.first_parameter() + (a.last_parameter() - a.first_parameter()) * k / 200.0;
    CHECK((engine::evaluate(a, t) - engine::evaluate(b, t)).norm() < kSame);
  }
}

void check_same_points(const NurbsSurface& a, const NurbsSurface& b) {
  for_each_parameter(a, 15, [&](double u, double v) {
    CHECK((engine::evaluate(a, u, v) - engine::evaluate(b, u, v)).norm() < kSame);
  });
}

bool is_clamped(const engine::Knots& knots, int degree) {
  const auto order = degree + 1;
  return std::count(knots.begin(), knots.end(), knots.front()) == order &&
         std::count(knots.begin(), knots.end(), knots.back()) == order;
}

/// A closed curve of even knots whose first control points come again at its end.
NurbsCurve periodic_curve(int degree, std::mt19937& random) {
  NurbsCurve curve;
  curve.degree = degree;
  constexpr int kDistinct = 6;
  for (int k = 0; k < kDistinct; ++k) curve.control_points.push_back(random_control_point(random));
  for (int k = 0; k < degree; ++k)
    curve.control_points.push_back(curve.control_points[static_cast<std::size_t>(k)]);
  for (int k = 0; k < kDistinct + 2 * degree + 1; ++k) curve.knots.push_back(k);
  return curve;
}

}  // namespace

TEST_CASE("inserted knots leave a curve where it was", "[knot-insertion]") {
  std::mt19937 random(kRandomNurbsSeed);
  CAPTURE(kRandomNurbsSeed);
  for (int degree = 1; degree <= 5; ++degree) {
    for (const KnotEnds ends : {KnotEnds::kClamped, KnotEnds::kUnclamped}) {
      CAPTURE(degree, static_cast<int>(ends));
      const NurbsCurve curve = random_curve(degree, ends, random);
      const double first = curve.first_parameter();
      const double width = curve.last_parameter() - first;
      const std::vector<double> inserted{first + 0.1 * width, first + 0.5 * width, first + 0.93 * width};
      const NurbsCurve refined = engine::insert_knots(curve, inserted);
      CHECK(refined.control_points.size() == curve.control_points.size() + inserted.size());
      CHECK(refined.knots.size() == refined.control_points.size() + static_cast<std::size_t>(degree) + 1);
      CHECK(std::is_sorted(refined.knots.begin(), refined.knots.end()));
      check_same_points(curve, refined);
    }
  }
}

TEST_CASE("a knot inserted up to full multiplicity puts a control point on the curve", "[knot-insertion]") {
  std::mt19937 random(kRandomNurbsSeed);
  const int degree = 3;
  const NurbsCurve curve = random_curve(degree, KnotEnds::kClamped, random);
  const double knot = 0.5 * (curve.first_parameter() + curve.last_parameter());
  const NurbsCurve refined = engine::insert_knots(curve, {knot, knot, knot});
  check_same_points(curve, refined);
  double nearest = 1e9;
  for (const engine::Vector4& point : refined.control_points) {
    nearest = std::min(nearest, (engine::cartesian(point) - engine::evaluate(curve, knot)).norm());
  }
  CHECK(nearest < kSame);
}

TEST_CASE("a knot inserted onto an existing one leaves the curve where it was", "[knot-insertion]") {
  std::mt19937 random(kRandomNurbsSeed);
  const NurbsCurve curve = random_curve(4, KnotEnds::kClamped, random);
  const std::vector<double> breaks = engine::break_points(curve.knots, 4);
  check_same_points(curve, engine::insert_knots(curve, {breaks[1], breaks[2]}));
}

TEST_CASE("inserted knots leave a surface where it was", "[knot-insertion]") {
  std::mt19937 random(kRandomNurbsSeed);
  for (const auto& [degree_u, degree_v] : {std::pair{1, 2}, std::pair{3, 3}, std::pair{2, 5}}) {
    const NurbsSurface surface = random_surface(degree_u, degree_v, random);
    const double middle_u = 0.41 * surface.last_u();
    const double middle_v = 0.77 * surface.last_v();
    const NurbsSurface refined = engine::insert_knots(surface, {middle_u}, {middle_v, middle_v});
    CHECK(refined.net.count_u == surface.net.count_u + 1);
    CHECK(refined.net.count_v == surface.net.count_v + (degree_v >= 2 ? 2U : 1U));
    check_same_points(surface, refined);
  }
}

TEST_CASE("clamping keeps the domain and the points of unclamped curves", "[knot-insertion]") {
  std::mt19937 random(kRandomNurbsSeed);
  for (int degree = 1; degree <= 5; ++degree) {
    CAPTURE(degree);
    const NurbsCurve curve = random_curve(degree, KnotEnds::kUnclamped, random);
    const NurbsCurve result = engine::clamped(curve);
    CHECK(is_clamped(result.knots, degree));
    CHECK(result.knots.size() == result.control_points.size() + static_cast<std::size_t>(degree) + 1);
    check_same_points(curve, result);
  }
}

TEST_CASE("clamping a periodic curve gives a closed curve", "[knot-insertion]") {
  std::mt19937 random(kRandomNurbsSeed);
  for (int degree = 2; degree <= 4; ++degree) {
    const NurbsCurve curve = periodic_curve(degree, random);
    const NurbsCurve result = engine::clamped(curve);
    CHECK(is_clamped(result.knots, degree));
    check_same_points(curve, result);
    CHECK((result.control_points.front() - result.control_points.back()).norm() < kSame);
  }
}

TEST_CASE("clamping leaves a clamped curve alone", "[knot-insertion]") {
  std::mt19937 random(kRandomNurbsSeed);
  const NurbsCurve curve = random_curve(3, KnotEnds::kClamped, random);
  const NurbsCurve result = engine::clamped(curve);
  CHECK(result.knots == curve.knots);
  CHECK(result.control_points == curve.control_points);
}

TEST_CASE("clamping keeps the points of unclamped surfaces", "[knot-insertion]") {
  std::mt19937 random(kRandomNurbsSeed);
  for (const auto& [degree_u, degree_v] : {std::pair{1, 3}, std::pair{3, 2}}) {
    const NurbsSurface surface = random_surface(degree_u, degree_v, random, KnotEnds::kUnclamped);
    const NurbsSurface result = engine::clamped(surface);
    CHECK(is_clamped(result.knots_u, degree_u));
    CHECK(is_clamped(result.knots_v, degree_v));
    check_same_points(surface, result);
  }
}

}  // namespace lamina::tests
