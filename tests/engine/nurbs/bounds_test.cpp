#include "engine/model_bounds.h"
#include "engine/nurbs/bounds.h"

#include <random>

#include <catch2/catch.hpp>

#include "engine/slicer.h"
#include "tests/support/analytic_models.h"
#include "tests/support/random_nurbs.h"

namespace lamina::tests {

using engine::Box3;
using engine::Vector3;

TEST_CASE("bounds of analytic solids are theirs, not those of their nets", "[bounds]") {
  // A ninth of a turn about (1, 1, 1) takes the extremes away from the knots.
  Eigen::Affine3d turn = Eigen::Affine3d::Identity();
  turn.rotate(Eigen::AngleAxisd(0.7, Vector3(1, 1, 1).normalized()));
  const AnalyticModel ball = sphere(Vector3::Zero(), 3.0);
  const engine::NurbsSurface turned = transformed(ball.model.surfaces.front().nurbs, turn);
  for (const double tolerance : {1e-2, 1e-4}) {
    const Box3 box = engine::surface_bounds(engine::bezier_patches(turned), tolerance);
    CAPTURE(tolerance);
    CHECK((box.max() - Vector3::Constant(3.0)).cwiseAbs().maxCoeff() <= tolerance + 1e-12);
    CHECK((box.min() + Vector3::Constant(3.0)).cwiseAbs().maxCoeff() <= tolerance + 1e-12);
  }
  CHECK(engine::control_box(turned.net).max().maxCoeff() > 3.5);
}

TEST_CASE("bounds agree with dense sampling", "[bounds]") {
  std::mt19937 random(kRandomNurbsSeed);
  CAPTURE(kRandomNurbsSeed);
  for (int k = 0; k < 4; ++k) {
    const engine::NurbsSurface surface = random_surface(2 + k % 2, 3, random);
    Box3 dense;  // span by span: a double knot may be a crease, and an extreme may lie on it
    const auto breaks_u = engine::break_points(surface.knots_u, surface.degree_u);
    const auto breaks_v = engine::break_points(surface.knots_v, surface.degree_v);
    for (std::size_t i = 0; i + 1 < breaks_u.size(); ++i) {
      for (std::size_t j = 0; j + 1 < breaks_v.size(); ++j) {
        for (int s = 0; s <= 60; ++s) {
          for (int t = 0; t <= 60; ++t) {
            dense.extend(engine::evaluate(surface, breaks_u[i] + (breaks_u[i + 1] - breaks_u[i]) * s / 60,
                                          breaks_v[j] + (breaks_v[j + 1] - breaks_v[j]) * t / 60));
          }
        }
      }
    }
    constexpr double kTolerance = 1e-3;
    const Box3 box = engine::surface_bounds(engine::bezier_patches(surface), kTolerance);
    // The box misses at most the tolerance of the surface; the samples miss a smooth extreme by the square of
    // their spacing.
    CHECK((dense.max() - box.max()).maxCoeff() <= kTolerance);
    CHECK((box.min() - dense.min()).maxCoeff() <= kTolerance);
    CHECK((box.max() - dense.max()).maxCoeff() <= 1e-2);
    CHECK((dense.min() - box.min()).maxCoeff() <= 1e-2);
  }
}

TEST_CASE("a model's bounds are those of its surfaces to a micrometre", "[bounds]") {
  for (const AnalyticModel& solid : {sphere({1, 2, 3}, 4.0), flat_torus({0, 1, 0}, 4.0, 1.5),
                                     standing_torus({0, 1, 0}, 3.0, 1.0), box({0, 0, 0}, {1, 2, 3})}) {
    const Box3 bounds = engine::model_bounds(solid.model);
    CAPTURE(solid.model.name);
    CHECK((bounds.min() - solid.box.min()).cwiseAbs().maxCoeff() <= 1e-3);
    CHECK((bounds.max() - solid.box.max()).cwiseAbs().maxCoeff() <= 1e-3);
  }
}

}  // namespace lamina::tests
