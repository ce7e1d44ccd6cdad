#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "engine/nurbs/arc.h"
#include "engine/nurbs/bezier_chain.h"
#include "engine/nurbs/conic.h"
#include "engine/nurbs/degree_elevation.h"
#include "engine/nurbs/join.h"
#include "engine/nurbs/power_basis.h"
#include "engine/nurbs/restrict.h"
#include "engine/nurbs/reverse.h"
#include "tests/engine/import/closed_forms.h"

using namespace lamina::engine;
using namespace lamina::tests;

namespace {

/// A rational cubic with an inner knot of each multiplicity.
NurbsCurve sample_curve() {
  NurbsCurve curve{3, {1, 1, 1, 1, 2, 3, 3, 4, 4, 4, 6, 6, 6, 6}, {}};
  for (int i = 0; i < 10; ++i) {
    curve.control_points.push_back(
        homogeneous({i * 1.0, std::sin(i), std::cos(2.0 * i)}, 1.0 + 0.4 * std::sin(3.0 * i)));
  }
  return curve;
}

double worst_distance(const NurbsCurve& a, const NurbsCurve& b, double first, double last) {
  double worst = 0.0;
  for (const double t : steps(first, last, 101))
    worst = std::max(worst, (evaluate(a, t) - evaluate(b, t)).norm());
  return worst;
}

}  // namespace

TEST_CASE("a Bezier chain is the curve, cut at its knots or at more") {
  const NurbsCurve curve = sample_curve();
  CHECK(worst_distance(curve, to_curve(bezier_chain(curve)), 1, 6) < 1e-13);
  CHECK(worst_distance(curve, to_curve(bezier_chain(curve, {1, 1.5, 2, 3, 3.75, 4, 6})), 1, 6) < 1e-13);
  CHECK(worst_distance(curve, to_curve(bezier_chain(curve, {1.25, 2, 2.5})), 1.25, 2.5) < 1e-13);
}

TEST_CASE("degree elevation leaves the curve where it is") {
  const NurbsCurve curve = sample_curve();
  for (int degree = 3; degree <= 7; ++degree) {
    const NurbsCurve raised = to_curve(elevated(bezier_chain(curve), degree));
    CHECK(raised.degree == degree);
    CHECK(worst_distance(curve, raised, 1, 6) < 1e-12);
  }
}

TEST_CASE("reversal and restriction") {
  const NurbsCurve curve = sample_curve();
  const NurbsCurve backwards = reversed(curve);
  for (const double t : steps(1, 6, 50))
    CHECK((evaluate(backwards, t) - evaluate(curve, 7.0 - t)).norm() < 1e-13);
  for (const auto& [first, last] :
       std::vector<std::pair<double, double>>{{1, 6}, {1, 2}, {1.5, 5}, {2, 4}, {3, 3.5}, {4, 6}}) {
    const NurbsCurve piece = restricted(curve, first, last);
    CHECK(piece.knots.size() == piece.control_points.size() + 4);
    CHECK(piece.first_parameter() == first);
    CHECK(piece.last_parameter() == last);
    CHECK(worst_distance(curve, piece, first, last) < 1e-13);
    CHECK((cartesian(piece.control_points.front()) - evaluate(curve, first)).norm() < 1e-13);
    CHECK((cartesian(piece.control_points.back()) - evaluate(curve, last)).norm() < 1e-13);
  }
}

TEST_CASE("joined pieces of different degree and weight keep their parameters") {
  const NurbsCurve curve = sample_curve();
  NurbsCurve scaled = restricted(curve, 4, 6);
  for (Vector4& point : scaled.control_points) point *= 5.0;  // the same curve
  const NurbsCurve whole = joined({restricted(curve, 1, 4), scaled});
  for (const double t : steps(0, 5, 100)) CHECK((evaluate(whole, t) - evaluate(curve, t + 1)).norm() < 1e-12);
  const NurbsCurve line{1, {0, 0, 2, 2}, {homogeneous(evaluate(curve, 6)), homogeneous({0, 0, 50})}};
  const NurbsCurve longer = joined({curve, line});
  CHECK(longer.degree == 3);
  CHECK((evaluate(longer, 6.0) - 0.5 * (evaluate(curve, 6) + Vector3(0, 0, 50))).norm() < 1e-12);
}

TEST_CASE("arcs have as many segments as they need, and weights above cos 45 degrees") {
  constexpr double kPi = std::numbers::pi;
  CHECK(arc_breaks(0, 2 * kPi).size() == 5);
  CHECK(arc_breaks(0, kPi / 2).size() == 2);
  CHECK(arc_breaks(0, kPi / 2 + 0.01).size() == 3);
  const NurbsCurve arc = ellipse_arc({1, 2, 3}, {2, 0, 0}, {0, 0, 5}, 0.5, 5.5);
  for (const Vector4& point : arc.control_points) CHECK(point.w() > std::cos(kPi / 4) - 1e-12);
  for (const double t : steps(0.5, 5.5, 200)) {
    const Vector3 p = evaluate(arc, t);
    CHECK(std::abs(std::pow((p.x() - 1) / 2, 2) + std::pow((p.z() - 3) / 5, 2) - 1) < 1e-14);
    // The parameter is the angle within 0.02.
    const double angle = std::atan2((p.z() - 3) / 5, (p.x() - 1) / 2);
    CHECK(std::abs(std::remainder(angle - t, 2 * kPi)) < 0.02);
  }
}

TEST_CASE("conics are told apart by their coefficients, whatever their factor and place") {
  for (const double factor : {1.0, -1.0, 1e-6, 1e6}) {
    const auto scaled = [factor](Conic q) {
      return Conic{factor * q.a, factor * q.b, factor * q.c, factor * q.d, factor * q.e, factor * q.f};
    };
    CHECK(classify(scaled({1, 0, 1, 0, 0, -1})) == ConicKind::kEllipse);
    CHECK(classify(scaled({1, 0, 1, -2e4, 0, 1e8 - 1})) == ConicKind::kEllipse);  // radius 1 at (1e4, 0)
    CHECK(classify(scaled({1e-4, 0, 2e-4, 0, 0, -1})) == ConicKind::kEllipse);
    CHECK(classify(scaled({1, 0, 1, 0, 0, 1})) == ConicKind::kDegenerate);   // no real point
    CHECK(classify(scaled({1, 0, 1, 0, 0, 0})) == ConicKind::kDegenerate);   // one point
    CHECK(classify(scaled({1, 0, -1, 0, 0, 0})) == ConicKind::kDegenerate);  // two lines
    CHECK(classify(scaled({0, 0, 0, 1, 2, 3})) == ConicKind::kDegenerate);   // one line
    CHECK(classify(scaled({1, 0, -1, 0, 0, 3})) == ConicKind::kHyperbola);
    CHECK(classify(scaled({0, 1, 0, 0, 0, -1})) == ConicKind::kHyperbola);
    CHECK(classify(scaled({1, 2, 1, 0, 3, 0})) == ConicKind::kParabola);
    CHECK(classify(scaled({0, 0, 2, 1, 0, 0})) == ConicKind::kParabola);
  }
}

TEST_CASE("power basis to Bezier") {
  const std::vector<Vector3> coefficients{{1, 2, 3}, {-1, 0.5, 2}, {0.25, 1, -3}, {2, -2, 0.125}};
  for (std::size_t count = 1; count <= 4; ++count) {
    const std::vector<Vector3> c(coefficients.begin(),
                                 coefficients.begin() + static_cast<std::ptrdiff_t>(count));
    const std::vector<Vector3> points = bezier_from_power(c, 2.5);
    REQUIRE(points.size() == count);
    for (const double s : steps(0, 2.5, 20)) {
      Vector3 expected = Vector3::Zero();
      for (std::size_t k = count; k-- > 0;) expected = expected * s + c[k];
      const std::vector<double> basis = bernstein(static_cast<int>(count) - 1, s / 2.5);
      Vector3 found = Vector3::Zero();
      for (std::size_t k = 0; k < count; ++k) found += basis[k] * points[k];
      CHECK((found - expected).norm() < 1e-12);
    }
  }
}
