#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "tests/engine/import/closed_forms.h"
#include "tests/engine/import/reading.h"

using namespace lamina::engine;
using namespace lamina::tests;

namespace {

constexpr double kPi = std::numbers::pi;

std::string arc(double z, Vector2 center, Vector2 start, Vector2 end) {
  return reals({z, center.x(), center.y(), start.x(), start.y(), end.x(), end.y()});
}

Vector2 polar(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace

TEST_CASE("100: arcs between all quadrants run counter-clockwise on their circle") {
  const Vector2 center(3.0, -7.0);
  constexpr double kRadius = 2.5;
  for (int i = 0; i < 16; ++i) {
    for (int j = 0; j < 16; ++j) {
      const double first = -kPi + 2.0 * kPi * i / 16.0 + 0.1;
      const double last = first + 2.0 * kPi * (j == 0 ? 16 : j) / 16.0;
      const Vector2 start = center + polar(kRadius, first);
      const Vector2 end = j == 0 ? start : Vector2(center + polar(kRadius, last));
      const NurbsCurve curve = read_curve({{100, arc(1.25, center, start, end), 0, 0, "00010000"}}, 0);
      double turned = 0.0;
      Vector3 previous = evaluate(curve, 0.0);
      REQUIRE((previous.head<2>() - start).norm() < 1e-12);
      for (const double t : steps(0.0, 1.0, 64)) {
        const Vector3 point = evaluate(curve, t);
        REQUIRE(point.z() == Approx(1.25).margin(1e-12));
        REQUIRE(std::abs((point.head<2>() - center).norm() - kRadius) < 1e-12);
        const Vector2 a = previous.head<2>() - center;
        const Vector2 b = point.head<2>() - center;
        turned += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
        previous = point;
      }
      REQUIRE((previous.head<2>() - end).norm() < 1e-12);
      REQUIRE(turned == Approx(last - first).margin(1e-10));
    }
  }
}

TEST_CASE("100: the parameter is the angle at every knot") {
  const NurbsCurve curve = read_curve({{100, arc(0.0, {0, 0}, {5, 0}, polar(5, 3.0)), 0, 0, "00010000"}}, 0);
  for (const double knot : curve.knots) {
    const Vector3 point = evaluate(curve, knot);
    CHECK(std::atan2(point.y(), point.x()) == Approx(3.0 * knot).margin(1e-12));
  }
}

TEST_CASE("104: ellipse arcs lie on the conic and run counter-clockwise from start to end") {
  // Semi-axes 5 and 2, turned by 0.4, center (1, -2).
  const double c = std::cos(0.4);
  const double s = std::sin(0.4);
  const auto point_at = [&](double t) {
    return Vector2(1.0 + c * 5.0 * std::cos(t) - s * 2.0 * std::sin(t),
                   -2.0 + s * 5.0 * std::cos(t) + c * 2.0 * std::sin(t));
  };
  const double a = c * c / 25.0 + s * s / 4.0;
  const double b = 2.0 * c * s * (1.0 / 25.0 - 1.0 / 4.0);
  const double cc = s * s / 25.0 + c * c / 4.0;
  const double d = -2.0 * a * 1.0 - b * -2.0;
  const double e = -b * 1.0 - 2.0 * cc * -2.0;
  const double f = a - 2.0 * b + 4.0 * cc - 1.0;
  for (const double first : {0.0, 1.0, 2.5, 4.0}) {
    for (const double sweep : {0.3, 1.6, 3.5, 6.0, 2.0 * kPi}) {
      for (const double sign : {1.0, -3.0}) {  // the equation is known up to a factor
        const Vector2 start = point_at(first);
        const Vector2 end = sweep > 6.1 ? start : point_at(first + sweep);
        const NurbsCurve curve = read_curve({{104,
                                              reals({sign * a, sign * b, sign * cc, sign * d, sign * e,
                                                     sign * f, 9.0, start.x(), start.y(), end.x(), end.y()}),
                                              1, 0, "00010000"}},
                                            0);
        double previous = -1e-9;
        for (const double t : steps(0.0, 1.0, 50)) {
          const Vector3 p = evaluate(curve, t);
          const double value =
              a * p.x() * p.x() + b * p.x() * p.y() + cc * p.y() * p.y() + d * p.x() + e * p.y() + f;
          CHECK(std::abs(value) < 1e-12);
          CHECK(p.z() == Approx(9.0));
          // Eccentric angle from the start, which must grow from 0 to the sweep.
          const Vector2 local(p.x() - 1.0, p.y() + 2.0);
          double angle =
              std::atan2((-s * local.x() + c * local.y()) / 2.0, (c * local.x() + s * local.y()) / 5.0) -
              first;
          while (angle < previous - 0.5) angle += 2.0 * kPi;
          CHECK(angle >= previous);
          CHECK(angle <= sweep + 1e-9);
          previous = angle;
        }
        CHECK(previous == Approx(sweep).margin(1e-9));
        CHECK((evaluate(curve, 0.0).head<2>() - start).norm() < 1e-12);
        CHECK((evaluate(curve, 1.0).head<2>() - end).norm() < 1e-12);
      }
    }
  }
}

TEST_CASE("104: parabola arcs lie on the conic between their ends") {
  for (const auto& [first, last] :
       std::vector<std::pair<double, double>>{{-3, 4}, {4, -3}, {0.5, 6}, {-1, -0.25}}) {
    // 2 x^2 - 8 y = 0, so y = x^2 / 4.
    const NurbsCurve curve =
        read_curve({{104, reals({2, 0, 0, 0, -8, 0, 1, first, first * first / 4, last, last * last / 4}), 3,
                     0, "00010000"}},
                   0);
    double previous = first;
    for (const double t : steps(0.0, 1.0, 40)) {
      const Vector3 p = evaluate(curve, t);
      CHECK(std::abs(p.x() * p.x() / 4 - p.y()) < 1e-12);
      CHECK((p.x() - previous) * (last - first) >= 0.0);
      previous = p.x();
    }
    CHECK(evaluate(curve, 0.0).x() == Approx(first));
    CHECK(evaluate(curve, 1.0).x() == Approx(last));
  }
}

TEST_CASE("104: hyperbola arcs stay on the branch of their ends") {
  // x^2 / 9 - y^2 / 4 = 1.
  for (const double branch : {1.0, -1.0}) {
    for (const auto& [first, last] :
         std::vector<std::pair<double, double>>{{-1, 1.5}, {2, -2.5}, {0.1, 4}, {-5, 5}}) {
      const auto point_at = [&](double t) { return Vector2(branch * 3 * std::cosh(t), 2 * std::sinh(t)); };
      const Vector2 start = point_at(first);
      const Vector2 end = point_at(last);
      const NurbsCurve curve =
          read_curve({{104, reals({1.0 / 9, 0, -0.25, 0, 0, -1, 0, start.x(), start.y(), end.x(), end.y()}),
                       2, 0, "00010000"}},
                     0);
      double previous = start.y();
      for (const double t : steps(0.0, 1.0, 100)) {
        const Vector3 p = evaluate(curve, t);
        const double size = 1.0 + p.squaredNorm();
        CHECK(std::abs(p.x() * p.x() / 9 - p.y() * p.y() / 4 - 1) < 1e-12 * size);
        CHECK(p.x() * branch > 0.0);
        CHECK((p.y() - previous) * (last - first) >= 0.0);
        previous = p.y();
      }
      CHECK((evaluate(curve, 0.0).head<2>() - start).norm() < 1e-12 * start.norm());
      CHECK((evaluate(curve, 1.0).head<2>() - end).norm() < 1e-12 * end.norm());
      for (const Vector4& point : curve.control_points) CHECK((point.w() > 0.0 && point.w() < 2.0));
    }
  }
}

TEST_CASE("112: piecewise polynomials of every spline type and degree") {
  for (int type = 1; type <= 6; ++type) {
    for (int degree = 1; degree <= 3; ++degree) {
      const std::vector<double> breaks{-1.0, 0.5, 2.0, 2.75};
      // Continuous by construction: each segment starts where the one before ends.
      std::vector<std::array<Vector3, 4>> segments(3);
      Vector3 start(1, 2, 3);
      for (std::size_t i = 0; i < 3; ++i) {
        const double k = static_cast<double>(i) + 1.0;
        segments[i] = {start, Vector3(k, -2, 0.5), Vector3(0.25, k, -1), Vector3(-0.5, 0.125, 0.3 * k)};
        for (int power = degree + 1; power < 4; ++power)
          segments[i][static_cast<std::size_t>(power)].setZero();
        const double h = breaks[i + 1] - breaks[i];
        start = segments[i][0] + h * segments[i][1] + h * h * segments[i][2] + h * h * h * segments[i][3];
      }
      std::string text = std::to_string(type) + ",1,3,3," + reals(breaks);
      for (const auto& segment : segments) {
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
          for (const Vector3& coefficient : segment) text += "," + reals({coefficient[axis]});
        }
      }
      text += "," + reals(std::vector<double>(12, 0.0));
      const NurbsCurve curve = read_curve({{112, text, 0, 0, "00010000"}}, 0);
      CHECK(curve.degree == degree);
      for (const double t : steps(0.0, 0.999, 37)) {
        const double u = -1.0 + 3.75 * t;
        const std::size_t i = u < 0.5 ? 0 : (u < 2.0 ? 1 : 2);
        const double x = u - breaks[i];
        const Vector3 expected =
            segments[i][0] + x * segments[i][1] + x * x * segments[i][2] + x * x * x * segments[i][3];
        CHECK((evaluate(curve, t) - expected).norm() < 1e-12);
      }
    }
  }
}

TEST_CASE("126: clamped, unclamped and periodic knots, weights, and a part of the range") {
  struct Case {
    std::string name;
    int degree;
    std::vector<double> knots;
    double first;
    double last;
  };
  const std::vector<Case> cases{
      {"clamped", 3, {0, 0, 0, 0, 1, 2, 2, 3, 3, 3, 3}, 0, 3},
      {"unclamped", 3, {-3, -2, -0.5, 0, 1, 2.5, 3, 4, 5, 6.5, 7}, 0, 4},
      {"periodic", 2, {-2, -1, 0, 1, 2, 3, 4, 5, 6, 7}, 0, 5},
      {"a part", 3, {0, 0, 0, 0, 1, 2, 2, 3, 3, 3, 3}, 0.25, 2.5},
      {"a part ending on a knot", 3, {0, 0, 0, 0, 1, 2, 2, 3, 3, 3, 3}, 1, 2},
      {"a part of unclamped", 3, {-3, -2, -0.5, 0, 1, 2.5, 3, 4, 5, 6.5, 7}, 0.125, 3.5},
      {"degree 1", 1, {0, 0, 1, 3, 4, 4}, 0, 4},
  };
  for (const Case& example : cases) {
    INFO(example.name);
    const std::size_t count = example.knots.size() - static_cast<std::size_t>(example.degree) - 1;
    std::vector<WeightedPoint> points;
    std::vector<double> weights;
    std::vector<double> coordinates;
    for (std::size_t i = 0; i < count; ++i) {
      const auto k = static_cast<double>(i);
      points.push_back({Vector3(k, std::sin(2.0 * k), 0.3 * k * k), 1.0 + 0.5 * std::cos(k)});
      weights.push_back(points.back().weight);
      for (const double x : points.back().point) coordinates.push_back(x);
    }
    const NurbsCurve curve =
        read_curve({{126,
                     std::to_string(count - 1) + "," + std::to_string(example.degree) + ",0,0,0,0," +
                         reals(example.knots) + "," + reals(weights) + "," + reals(coordinates) + "," +
                         reals({example.first, example.last}) + ",0.,0.,1.",
                     0, 0, "00010000"}},
                   0);
    for (int i = 0; i <= curve.degree; ++i) {
      CHECK(curve.knots[static_cast<std::size_t>(i)] == 0.0);
      CHECK(curve.knots[curve.knots.size() - 1 - static_cast<std::size_t>(i)] == 1.0);
    }
    for (const double t : steps(0.0, 0.999999, 53)) {
      const double u = example.first + (example.last - example.first) * t;
      CHECK((evaluate(curve, t) - curve_by_definition(example.knots, example.degree, points, u)).norm() <
            1e-12);
    }
  }
}

TEST_CASE("102: pieces of every kind in one curve") {
  // Line (parameter length 1), quarter circle (pi / 2), cubic (range 2), all in turn.
  std::vector<IgesEntity> entities{
      {110, "0.,0.,0.,4.,0.,0.", 0, 0, "00010000"},
      {100, "0.,4.,3.,4.,0.,7.,3.", 0, 0, "00010000"},
      {126,
       "3,3,0,0,1,0,0.,0.,0.,0.,2.,2.,2.,2.,1.,1.,1.,1.,7.,3.,0.,8.,3.,1.,9.,4.,2.,9.,6.,5.,0.,2.,0.,0.,1.",
       0, 0, "00010000"},
      {102, "3,1,3,5", 0, 0, "00010000"}};
  const NurbsCurve curve = read_curve(entities, 3);
  CHECK(curve.degree == 3);
  const double total = 1.0 + kPi / 2.0 + 2.0;
  CHECK((evaluate(curve, 0.5 / total) - Vector3(2, 0, 0)).norm() < 1e-12);
  CHECK((evaluate(curve, 1.0 / total) - Vector3(4, 0, 0)).norm() < 1e-12);
  CHECK((evaluate(curve, (1.0 + kPi / 2.0) / total) - Vector3(7, 3, 0)).norm() < 1e-12);
  CHECK((evaluate(curve, 1.0) - Vector3(9, 6, 5)).norm() < 1e-12);
  for (const double t : steps(1.001, 1.0 + kPi / 2.0, 20)) {
    CHECK(std::abs((evaluate(curve, t / total) - Vector3(4, 3, 0)).norm() - 3.0) < 1e-12);
  }
  for (const double s : steps(0.0, 1.0, 20)) {
    const double r = 1.0 - s;
    const Vector3 expected = r * r * r * Vector3(7, 3, 0) + 3 * r * r * s * Vector3(8, 3, 1) +
                             3 * r * s * s * Vector3(9, 4, 2) + s * s * s * Vector3(9, 6, 5);
    CHECK((evaluate(curve, (1.0 + kPi / 2.0 + 2.0 * s) / total) - expected).norm() < 1e-12);
  }
}

TEST_CASE("102: nested, with a point among the pieces and one piece running backwards") {
  std::vector<IgesEntity> entities{{110, "0.,0.,0.,1.,0.,0.", 0, 0, "00010000"},
                                   {110, "1.,1.,0.,1.,0.,0.", 0, 0, "00010000"},
                                   {102, "2,1,3", 0, 0, "00010000"},
                                   {116, "1.,1.,0.,0", 0, 0, "00010000"},
                                   {110, "1.,1.,0.,1.,1.,8.", 0, 0, "00010000"},
                                   {102, "3,5,7,9", 0, 0, "00010000"},
                                   {116, "0.,0.,9.,0", 0, 0, "00010000"},
                                   {118, "11,13,0,0", 1}};
  const ImportResult result = read_iges(iges_text(entities), "part.igs");
  const NurbsSurface& surface = result.model.surfaces.at(0).nurbs;
  CHECK((evaluate(surface, 2.0 / 3.0, 0.0) - Vector3(1, 1, 0)).norm() < 1e-12);
  CHECK((evaluate(surface, 1.0, 0.0) - Vector3(1, 1, 8)).norm() < 1e-12);
  CHECK(tolerated(result.report).find("runs backwards") != std::string::npos);
}

TEST_CASE("124: a transformation on every kind of curve, and nested ones") {
  // A turn about z by 90 degrees and a shift; the second turns about x and is named by the first.
  const IgesEntity outer{124, "1.,0.,0.,10.,0.,0.,-1.,20.,0.,1.,0.,30.", 0, 0, "00000000"};
  const IgesEntity inner{124, "0.,-1.,0.,1.,1.,0.,0.,2.,0.,0.,1.,3.", 0, 1, "00000000"};
  const auto moved = [](const Vector3& p) {
    const Vector3 q(-p.y() + 1, p.x() + 2, p.z() + 3);
    return Vector3(q.x() + 10, -q.z() + 20, q.y() + 30);
  };
  const std::vector<IgesEntity> curves{
      {100, "1.,0.,0.,2.,0.,0.,2."},
      {104, "1.,0.,4.,0.,0.,-4.,1.,2.,0.,0.,1.", 1},
      {110, "1.,2.,3.,4.,5.,7."},
      {112, "3,1,3,1,0.,2.,1.,1.,0.5,0.,2.,0.,1.,0.,3.,0.,0.,1.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0."},
      {126, "2,2,0,0,0,0,0.,0.,0.,1.,1.,1.,1.,2.,1.,0.,0.,0.,1.,2.,3.,4.,4.,0.,0.,1.,0.,0.,1."}};
  for (IgesEntity curve : curves) {
    INFO(curve.type);
    curve.status = "00010000";
    const NurbsCurve plain = read_curve({curve}, 0);
    curve.transform = 3;
    const NurbsCurve placed = read_curve({outer, inner, curve}, 2);
    // The same through a composite curve that is itself placed.
    IgesEntity unplaced = curve;
    unplaced.transform = 0;
    const NurbsCurve composed = read_curve({outer, inner, unplaced, {102, "1,5", 0, 3, "00010000"}}, 3);
    for (const double t : steps(0.0, 1.0, 20)) {
      CHECK((evaluate(placed, t) - moved(evaluate(plain, t))).norm() < 1e-12);
      CHECK((evaluate(composed, t) - moved(evaluate(plain, t))).norm() < 1e-12);
    }
  }
}
