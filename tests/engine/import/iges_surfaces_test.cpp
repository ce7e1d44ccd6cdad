#include <array>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "tests/engine/import/closed_forms.h"
#include "tests/engine/import/reading.h"

using namespace lamina::engine;
using namespace lamina::tests;

namespace {

constexpr double kPi = std::numbers::pi;

const IgesEntity kZAxis{110, "0.,0.,-1.,0.,0.,4.", 0, 0, "00010000"};

/// Distance of a surface of revolution's points from what `expected` computes of them, over the whole domain.
template <typename Distance>
double largest(const NurbsSurface& surface, const Distance& distance) {
  double worst = 0.0;
  for (const double u : steps(surface.first_u(), surface.last_u(), 24)) {
    for (const double v : steps(surface.first_v(), surface.last_v(), 24)) {
      worst = std::max(worst, std::abs(distance(evaluate(surface, u, v))));
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("120: a half circle turned about its diameter is a sphere") {
  const IgesEntity half{100, "0.,0.,0.,0.,-5.,0.,5.", 0, 0, "00010000"};  // in xy, about the y axis
  const IgesEntity y_axis{110, "0.,-9.,0.,0.,9.,0.", 0, 0, "00010000"};
  const NurbsSurface sphere = only_surface({half, y_axis, {120, "3,1,0.,6.2831853071795862"}});
  CHECK(largest(sphere, [](const Vector3& p) { return p.norm() - 5.0; }) < 1e-12);
}

TEST_CASE("120: a circle turned about an axis beside it is a torus") {
  const IgesEntity circle{100, "0.,8.,1.,10.,1.,10.,1.", 0, 0, "00010000"};
  const IgesEntity y_axis{110, "0.,0.,0.,0.,1.,0.", 0, 0, "00010000"};
  const NurbsSurface torus = only_surface({circle, y_axis, {120, "3,1,1.,7.2831853071795862"}});
  CHECK(largest(torus, [](const Vector3& p) {
          return std::hypot(std::hypot(p.x(), p.z()) - 8.0, p.y() - 1.0) - 2.0;
        }) < 1e-12);
}

TEST_CASE("120: partial angles about any axis turn counter-clockwise from the generatrix") {
  const Vector3 foot(1, 2, 3);
  const Vector3 direction = Vector3(2, -1, 2).normalized();
  const Vector3 end = foot + 4.0 * direction;
  const Vector3 a(4, 5, 6);
  const Vector3 b(-2, 7, 1);
  const auto line = [](const Vector3& p, const Vector3& q) {
    return IgesEntity{110, reals({p.x(), p.y(), p.z(), q.x(), q.y(), q.z()}), 0, 0, "00010000"};
  };
  for (const auto& [first, last] :
       std::vector<std::pair<double, double>>{{0, 1}, {0.5, 4}, {-1, 2 * kPi - 1.5}, {3, 3.25}}) {
    const NurbsSurface surface =
        only_surface({line(foot, end), line(a, b), {120, "1,3," + reals({first, last})}});
    for (const double u : steps(0.0, 1.0, 10)) {
      const Vector3 point = (1.0 - u) * a + u * b;
      const auto turned = [&](double angle) {
        return Vector3(foot + Eigen::AngleAxisd(angle, direction) * (point - foot));
      };
      CHECK((evaluate(surface, u, surface.first_v()) - turned(first)).norm() < 1e-12);
      CHECK((evaluate(surface, u, surface.last_v()) - turned(last)).norm() < 1e-12);
      for (const double knot : surface.knots_v)
        CHECK((evaluate(surface, u, knot) - turned(knot)).norm() < 1e-12);
      for (const double v : steps(first, last, 30)) {
        const Vector3 p = evaluate(surface, u, v) - foot;
        const Vector3 q = point - foot;
        CHECK(p.dot(direction) == Approx(q.dot(direction)).margin(1e-12));
        CHECK(p.norm() == Approx(q.norm()).margin(1e-12));
        CHECK((evaluate(surface, u, v) - turned(v)).norm() < 0.025 * q.norm());
      }
    }
  }
}

TEST_CASE("118: form 1 joins rails at equal relative parameters, the second backwards with DIRFLG 1") {
  const IgesEntity line{110, "0.,0.,0.,6.,0.,1.", 0, 0, "00010000"};
  const IgesEntity cubic{
      126,
      "4,2,0,0,1,0,2.,2.,2.,3.,5.,6.,6.,6.,1.,1.,1.,1.,1.,0.,5.,0.,1.,6.,2.,3.,7.,0.,4.,5.,1.,"
      "6.,5.,3.,2.,6.,0.,0.,1.",
      0, 0, "00010000"};
  // Five points at degree 2 need 8 knots; the curve by its definition for comparison.
  const std::vector<double> knots{2, 2, 2, 3, 5, 6, 6, 6};
  const std::vector<WeightedPoint> points{{{0, 5, 0}}, {{1, 6, 2}}, {{3, 7, 0}}, {{4, 5, 1}}, {{6, 5, 3}}};
  for (const bool backwards : {false, true}) {
    const NurbsSurface surface = only_surface({line, cubic, {118, backwards ? "1,3,1,0" : "1,3,0,0", 1}});
    for (const double u : steps(0.0, 1.0, 30)) {
      const double t = 2.0 + 4.0 * std::min(backwards ? 1.0 - u : u, 1.0 - 1e-15);
      const Vector3 first(6 * u, 0, u);
      const Vector3 second = curve_by_definition(knots, 2, points, t);
      for (const double v : steps(0.0, 1.0, 4)) {
        CHECK((evaluate(surface, u, v) - (first + v * (second - first))).norm() < 1e-11);
      }
    }
  }
}

TEST_CASE("118: form 0 is exact for rails that run alike, and reports the shift otherwise") {
  const IgesEntity low{100, "0.,0.,0.,4.,0.,-4.,0.", 0, 0, "00010000"};
  const IgesEntity high{100, "3.,0.,0.,2.,0.,-2.,0.", 0, 0, "00010000"};
  const ImportResult cone = read_iges(iges_text({low, high, {118, "1,3,0,0", 0}}), "part.igs");
  CHECK(cone.report.tolerated.empty());
  CHECK(largest(cone.model.surfaces[0].nurbs, [](const Vector3& p) {
          return std::hypot(p.x(), p.y()) - (4.0 - 2.0 * p.z() / 3.0);
        }) < 1e-12);

  // A line whose parameter runs unevenly: a quadratic B-spline with its middle point off the middle.
  const IgesEntity uneven{126,
                          "2,2,0,0,1,0,0.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,9.,1.,0.,9.,8.,0.,9.,0.,1.,0.,0.,1.",
                          0, 0, "00010000"};
  const IgesEntity even{110, "0.,0.,0.,8.,0.,0.", 0, 0, "00010000"};
  const ImportResult shifted = read_iges(iges_text({even, uneven, {118, "1,3,0,0", 0}}), "part.igs");
  CHECK(tolerated(shifted.report).find("joined at equal parameter") != std::string::npos);
  // At u the second rail is at 2 u (1 - u) + 8 u^2: furthest from 8 u at u = 1 / 2, by 1.5.
  CHECK(tolerated(shifted.report).find("by up to 1.5 file units") != std::string::npos);
  CHECK(read_iges(iges_text({even, uneven, {118, "1,3,0,0", 1}}), "part.igs").report.tolerated.empty());
}

TEST_CASE("118: rails of different weights, degrees and knots still span the straight lines between them") {
  const IgesEntity arc{100, "0.,0.,0.,4.,0.,0.,4.", 0, 0, "00010000"};
  const IgesEntity line{110, "6.,0.,5.,0.,6.,5.", 0, 0, "00010000"};
  const NurbsSurface surface = only_surface({arc, line, {118, "1,3,0,0", 1}});
  for (const double u : steps(0.0, 1.0, 20)) {
    const Vector3 a = evaluate(surface, u, 0.0);
    const Vector3 b = evaluate(surface, u, 1.0);
    CHECK(std::abs(std::hypot(a.x(), a.y()) - 4.0) < 1e-12);
    CHECK((b - Vector3(6 - 6 * u, 6 * u, 5)).norm() < 1e-12);
    for (const double v : steps(0.0, 1.0, 5)) {
      const Vector3 p = evaluate(surface, u, v);
      CHECK((p - a).cross(b - a).norm() < 1e-12 * (b - a).squaredNorm() + 1e-12);
    }
  }
}

TEST_CASE("114: patches of every type and degree, without the fill patches") {
  for (int degree = 1; degree <= 3; ++degree) {
    // One polynomial over the whole grid, re-expanded at each patch's corner: continuous by construction.
    const auto power = [](double x, int k) { return std::pow(x, k); };
    const auto binomial = [](int n, int k) {
      double value = 1.0;
      for (int i = 0; i < k; ++i) value = value * (n - i) / (i + 1);
      return value;
    };
    const auto global = [&](Eigen::Index axis, int k, int l) {
      return k > degree || l > degree ? 0.0 : std::sin(1.0 + static_cast<double>(axis) + 2.0 * k + 5.0 * l);
    };
    const std::vector<double> breaks_u{0, 0.5, 2};
    const std::vector<double> breaks_v{-1, 0, 0.75, 1};
    std::string text = "3,1,2,3," + reals(breaks_u) + "," + reals(breaks_v);
    for (std::size_t i = 0; i <= 2; ++i) {
      for (std::size_t j = 0; j <= 3; ++j) {
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
          for (int l = 0; l <= 3; ++l) {
            for (int k = 0; k <= 3; ++k) {
              double coefficient = 0.0;
              for (int kk = k; kk <= 3; ++kk) {
                for (int ll = l; ll <= 3; ++ll) {
                  coefficient += global(axis, kk, ll) * binomial(kk, k) * binomial(ll, l) *
                                 power(breaks_u[i], kk - k) * power(breaks_v[j], ll - l);
                }
              }
              const bool is_fill = i == 2 || j == 3;
              text += "," + reals({is_fill ? 777.0 : coefficient});
            }
          }
        }
      }
    }
    const NurbsSurface surface = only_surface({{114, text}});
    CHECK(surface.degree_u == degree);
    CHECK(surface.degree_v == degree);
    for (const double u : steps(0, 2, 17)) {
      for (const double v : steps(-1, 1, 17)) {
        Vector3 expected = Vector3::Zero();
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
          for (int k = 0; k <= 3; ++k) {
            for (int l = 0; l <= 3; ++l) expected[axis] += global(axis, k, l) * power(u, k) * power(v, l);
          }
        }
        CHECK((evaluate(surface, u, v) - expected).norm() < 1e-12 * (1.0 + expected.norm()) * 10);
      }
    }
  }
}

TEST_CASE("128: knots of every kind, weights, and the order of the control points") {
  struct Direction {
    int degree;
    std::vector<double> knots;
    double first;
    double last;
  };
  const std::vector<Direction> directions{{3, {0, 0, 0, 0, 1, 2, 2, 2, 2}, 0, 2},
                                          {2, {-2, -1, 0, 1, 2, 3, 4, 5}, 0, 3},
                                          {2, {-2, -1, 0, 1, 2, 3, 4, 5}, 0.5, 2},
                                          {1, {0, 0, 1, 4, 4}, 0, 4}};
  for (const Direction& in_u : directions) {
    for (const Direction& in_v : directions) {
      const std::size_t count_u = in_u.knots.size() - static_cast<std::size_t>(in_u.degree) - 1;
      const std::size_t count_v = in_v.knots.size() - static_cast<std::size_t>(in_v.degree) - 1;
      const auto point = [](std::size_t i, std::size_t j) {
        const auto x = static_cast<double>(i);
        const auto y = static_cast<double>(j);
        return WeightedPoint{Vector3(x, 2 * y, std::sin(x + 3 * y)), 1.0 + 0.3 * std::cos(2 * x + y)};
      };
      std::vector<double> weights;
      std::vector<double> coordinates;
      for (std::size_t j = 0; j < count_v; ++j) {
        for (std::size_t i = 0; i < count_u; ++i) {
          weights.push_back(point(i, j).weight);
          for (const double x : point(i, j).point) coordinates.push_back(x);
        }
      }
      const std::string text = std::to_string(count_u - 1) + "," + std::to_string(count_v - 1) + "," +
                               std::to_string(in_u.degree) + "," + std::to_string(in_v.degree) +
                               ",0,0,0,0,0," + reals(in_u.knots) + "," + reals(in_v.knots) + "," +
                               reals(weights) + "," + reals(coordinates) + "," +
                               reals({in_u.first, in_u.last, in_v.first, in_v.last});
      const NurbsSurface surface = only_surface({{128, text}});
      CHECK(surface.first_u() == in_u.first);
      CHECK(surface.last_v() == in_v.last);
      CHECK(surface.knots_u.front() == in_u.first);
      CHECK(surface.knots_v.back() == in_v.last);
      for (const double u : steps(in_u.first, in_u.last - 1e-9, 13)) {
        for (const double v : steps(in_v.first, in_v.last - 1e-9, 13)) {
          Vector3 sum = Vector3::Zero();
          double weight = 0.0;
          for (std::size_t i = 0; i < count_u; ++i) {
            for (std::size_t j = 0; j < count_v; ++j) {
              const double basis = basis_by_recursion(in_u.knots, i, in_u.degree, u) *
                                   basis_by_recursion(in_v.knots, j, in_v.degree, v) * point(i, j).weight;
              sum += basis * point(i, j).point;
              weight += basis;
            }
          }
          CHECK((evaluate(surface, u, v) - sum / weight).norm() < 1e-12);
        }
      }
    }
  }
}

TEST_CASE("124: surfaces and what they are made of are placed, each by its own") {
  // A cylinder of radius 2 about z, moved by its generatrix's, its axis's and its own transformation.
  const IgesEntity shift_x{124, "1.,0.,0.,5.,0.,1.,0.,0.,0.,0.,1.,0."};
  IgesEntity axis = kZAxis;
  axis.transform = 1;
  const IgesEntity side{110, "2.,0.,0.,2.,0.,3.", 0, 1, "00010000"};
  const IgesEntity turn{124, "0.,0.,1.,0.,1.,0.,0.,0.,0.,1.,0.,-1."};
  const NurbsSurface surface =
      only_surface({shift_x, axis, side, turn, {120, "3,5,0.,6.2831853071795862", 0, 7}});
  // Axis x = 5 along z becomes: x' = z, y' = x = 5, z' = y - 1 = -1.
  CHECK(largest(surface, [](const Vector3& p) { return std::hypot(p.y() - 5.0, p.z() + 1.0) - 2.0; }) <
        1e-12);
}
