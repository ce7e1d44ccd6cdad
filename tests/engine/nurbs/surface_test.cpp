#include "engine/nurbs/surface.h"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "engine/nurbs/curve.h"
#include "tests/support/analytic_models.h"
#include "tests/support/random_nurbs.h"

namespace lamina::tests {

using engine::NurbsSurface;
using engine::SurfaceDerivatives;
using engine::Vector3;

TEST_CASE("every point of the exact sphere lies on the sphere, its derivatives along it", "[surface]") {
  const Vector3 centre(1.0, -2.0, 0.5);
  const NurbsSurface surface = sphere(centre, 3.0).model.surfaces.front().nurbs;
  for (double u = 0.01; u < 1.0; u += 0.07) {
    for (double v = 0.01; v < 1.0; v += 0.07) {
      const SurfaceDerivatives d = engine::evaluate_derivatives(surface, u, v);
      const Vector3 radius = d.point - centre;
      CHECK((engine::evaluate(surface, u, v) - d.point).norm() < 1e-12);
      CHECK(radius.norm() == Approx(3.0).epsilon(1e-12));
      // |S - c|^2 = r^2, differentiated once and twice.
      CHECK(std::abs(radius.dot(d.du)) < 1e-9);
      CHECK(std::abs(radius.dot(d.dv)) < 1e-9);
      CHECK(std::abs(radius.dot(d.duu) + d.du.squaredNorm()) < 1e-7);
      CHECK(std::abs(radius.dot(d.dvv) + d.dv.squaredNorm()) < 1e-7);
      CHECK(std::abs(radius.dot(d.duv) + d.du.dot(d.dv)) < 1e-7);
    }
  }
}

TEST_CASE("surface derivatives agree with central differences", "[surface]") {
  std::mt19937 random(kRandomNurbsSeed);
  CAPTURE(kRandomNurbsSeed);
  constexpr double kStep = 1e-4;
  for (const auto& [degree_u, degree_v] :
       {std::pair{1, 1}, std::pair{2, 3}, std::pair{3, 1}, std::pair{4, 2}}) {
    const NurbsSurface surface = random_surface(degree_u, degree_v, random);
    const auto breaks_u = engine::break_points(surface.knots_u, degree_u);
    const auto breaks_v = engine::break_points(surface.knots_v, degree_v);
    for (std::size_t i = 0; i + 1 < breaks_u.size(); ++i) {
      for (std::size_t j = 0; j + 1 < breaks_v.size(); ++j) {
        const double u = breaks_u[i] + 0.4 * (breaks_u[i + 1] - breaks_u[i]);
        const double v = breaks_v[j] + 0.6 * (breaks_v[j + 1] - breaks_v[j]);
        const auto at = [&](double du, double dv) {
          return engine::evaluate(surface, u + du * kStep, v + dv * kStep);
        };
        const SurfaceDerivatives d = engine::evaluate_derivatives(surface, u, v);
        const auto agree = [](const Vector3& exact, const Vector3& difference) {
          return (exact - difference).norm() <= 1e-4 * (1.0 + exact.norm());
        };
        CAPTURE(degree_u, degree_v, u, v);
        CHECK(agree(d.point, at(0, 0)));
        CHECK(agree(d.du, (at(1, 0) - at(-1, 0)) / (2 * kStep)));
        CHECK(agree(d.dv, (at(0, 1) - at(0, -1)) / (2 * kStep)));
        CHECK(agree(d.duu, (at(1, 0) - 2 * at(0, 0) + at(-1, 0)) / (kStep * kStep)));
        CHECK(agree(d.dvv, (at(0, 1) - 2 * at(0, 0) + at(0, -1)) / (kStep * kStep)));
        CHECK(agree(d.duv, (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) / (4 * kStep * kStep)));
      }
    }
  }
}

TEST_CASE("a transposed surface has the same points with u and v exchanged", "[surface]") {
  std::mt19937 random(kRandomNurbsSeed);
  const NurbsSurface surface = random_surface(2, 3, random);
  const NurbsSurface turned = engine::transposed(surface);
  for_each_parameter(surface, 7, [&](double u, double v) {
    CHECK((engine::evaluate(surface, u, v) - engine::evaluate(turned, v, u)).norm() < 1e-12);
  });
}

TEST_CASE("the box of the net contains the surface", "[surface]") {
  std::mt19937 random(kRandomNurbsSeed);
  const NurbsSurface surface = random_surface(3, 2, random);
  engine::Box3 box = engine::control_box(surface.net);
  box = engine::Box3(box.min() - Vector3::Constant(1e-12), box.max() + Vector3::Constant(1e-12));
  for_each_parameter(surface, 20,
                     [&](double u, double v) { CHECK(box.contains(engine::evaluate(surface, u, v))); });
}

}  // namespace lamina::tests
