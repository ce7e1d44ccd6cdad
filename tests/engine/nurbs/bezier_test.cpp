#include "engine/nurbs/bezier.h"

#include <random>

#include <catch2/catch.hpp>

#include "engine/geometry/bspline_basis.h"
#include "tests/support/analytic_models.h"
#include "tests/support/random_nurbs.h"

namespace lamina::tests {
namespace {

using engine::BezierPatch;
using engine::NurbsSurface;

/// Patch (i, j) of the surface's spans has the surface's points, its parameters running over the span.
void check_patches(const NurbsSurface& surface, double tolerance) {
  const auto breaks_u = engine::break_points(surface.knots_u, surface.degree_u);
  const auto breaks_v = engine::break_points(surface.knots_v, surface.degree_v);
  const std::vector<BezierPatch> patches = engine::bezier_patches(surface);
  REQUIRE(patches.size() == (breaks_u.size() - 1) * (breaks_v.size() - 1));
  for (std::size_t i = 0; i + 1 < breaks_u.size(); ++i) {
    for (std::size_t j = 0; j + 1 < breaks_v.size(); ++j) {
      const BezierPatch& patch = patches[i * (breaks_v.size() - 1) + j];
      CHECK(patch.net.points.size() == patch.net.count_u * patch.net.count_v);
      for (const double s : {0.0, 0.3, 0.8}) {
        for (const double t : {0.0, 0.5, 0.9}) {
          const double u = breaks_u[i] + s * (breaks_u[i + 1] - breaks_u[i]);
          const double v = breaks_v[j] + t * (breaks_v[j + 1] - breaks_v[j]);
          CHECK((engine::evaluate(patch, s, t) - engine::evaluate(surface, u, v)).norm() < tolerance);
        }
      }
    }
  }
}

}  // namespace

TEST_CASE("the Bezier patches of a surface are the surface", "[bezier]") {
  std::mt19937 random(kRandomNurbsSeed);
  CAPTURE(kRandomNurbsSeed);
  for (const auto& [degree_u, degree_v] :
       {std::pair{1, 1}, std::pair{2, 2}, std::pair{3, 5}, std::pair{4, 1}}) {
    CAPTURE(degree_u, degree_v);
    check_patches(random_surface(degree_u, degree_v, random), 1e-10);
  }
}

TEST_CASE("knots of full multiplicity are cut without insertion", "[bezier]") {
  for (const AnalyticModel& solid : {sphere({0, 0, 0}, 2.0), flat_torus({0, 0, 0}, 3.0, 1.0)}) {
    check_patches(solid.model.surfaces.front().nurbs, 1e-12);
  }
}

TEST_CASE("a surface that is torn at a knot is cut there", "[bezier]") {
  // A knot of multiplicity degree + 1: two strips that do not touch.
  NurbsSurface torn;
  torn.degree_u = 1;
  torn.degree_v = 1;
  torn.knots_u = {0, 0, 1, 1, 2, 2};
  torn.knots_v = {0, 0, 1, 1};
  torn.net.count_u = 4;
  torn.net.count_v = 2;
  for (const double x : {0.0, 1.0, 5.0, 6.0}) {
    for (const double y : {0.0, 1.0}) torn.net.points.push_back(engine::homogeneous({x, y, 0.0}));
  }
  const std::vector<BezierPatch> patches = engine::bezier_patches(torn);
  REQUIRE(patches.size() == 2);
  CHECK((engine::evaluate(patches[0], 1.0, 0.0) - engine::Vector3(1, 0, 0)).norm() < 1e-12);
  CHECK((engine::evaluate(patches[1], 0.0, 1.0) - engine::Vector3(5, 1, 0)).norm() < 1e-12);
}

TEST_CASE("the halves of a patch are the patch", "[bezier]") {
  std::mt19937 random(kRandomNurbsSeed);
  for (const BezierPatch& patch : engine::bezier_patches(random_surface(3, 4, random))) {
    const auto [low_u, high_u] = engine::halves_in_u(patch);
    const auto [low_v, high_v] = engine::halves_in_v(patch);
    for (const double s : {0.0, 0.25, 0.6, 1.0}) {
      for (const double t : {0.0, 0.5, 0.9, 1.0}) {
        CHECK((engine::evaluate(low_u, s, t) - engine::evaluate(patch, 0.5 * s, t)).norm() < 1e-10);
        CHECK((engine::evaluate(high_u, s, t) - engine::evaluate(patch, 0.5 + 0.5 * s, t)).norm() < 1e-10);
        CHECK((engine::evaluate(low_v, s, t) - engine::evaluate(patch, s, 0.5 * t)).norm() < 1e-10);
        CHECK((engine::evaluate(high_v, s, t) - engine::evaluate(patch, s, 0.5 + 0.5 * t)).norm() < 1e-10);
      }
    }
  }
}

}  // namespace lamina::tests
