#include "engine/pointcloud/edge_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "engine/model.h"
#include "engine/nurbs/ruled.h"
#include "engine/pointcloud/trim_region.h"
#include "tests/support/trimmed_models.h"

namespace lamina::tests {
namespace {

using engine::BezierChain;
using engine::EdgeSample;
using engine::NurbsCurve;
using engine::NurbsSurface;
using engine::Vector2;
using engine::Vector3;

/// The upper half of a lying cylinder along y, radius 5, length 10, axis in the plane z = 0; v runs along it.
NurbsSurface lying_half_cylinder() {
  const auto rim = [](double y) {
    const double w = std::sqrt(0.5);
    return NurbsCurve{
        2,
        {0, 0, 0, 0.5, 0.5, 1, 1, 1},
        {engine::homogeneous({5, y, 0}), engine::homogeneous({5, y, 5}, w), engine::homogeneous({0, y, 5}),
         engine::homogeneous({-5, y, 5}, w), engine::homogeneous({-5, y, 0})}};
  };
  return engine::ruled_surface(rim(0.0), rim(10.0));
}

double highest(const std::vector<EdgeSample>& samples) {
  return std::max_element(
             samples.begin(), samples.end(),
             [](const EdgeSample& a, const EdgeSample& b) { return a.position.z() < b.position.z(); })
      ->position.z();
}

}  // namespace

TEST_CASE("edge samples: chords are within tolerance of the curve, and few", "[trim]") {
  const engine::Surface plane = trimmed_plane({0, 0, 0}, {10, 0, 0}, {0, 0, 10}, 0.0, {});
  const engine::TrimLoop circle = circle_loop({0.5, 0.5}, 0.3, false);
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    const BezierChain curve = engine::bezier_chain(circle.curves.front());
    const auto samples = engine::edge_samples(plane.nurbs, curve, tolerance);
    CAPTURE(tolerance, samples.size());
    for (std::size_t k = 1; k < samples.size(); ++k) {
      CHECK((samples[k].parameters - Vector2(0.5, 0.5)).norm() == Approx(0.3).margin(1e-12));
      const double half_chord = 0.5 * (samples[k].parameters - samples[k - 1].parameters).norm();
      CHECK(0.3 - std::sqrt(0.09 - half_chord * half_chord) <= tolerance);
    }
    // A regular polygon of that sagitta has pi / acos(1 - tolerance / radius) corners; halving has up to
    // twice as many, the control points' distance another half.
    const double least = std::numbers::pi / std::acos(1.0 - tolerance / 0.3);
    CHECK(static_cast<double>(samples.size()) <= 3.0 * least + 8.0);
  }
}

TEST_CASE("edge samples: a straight curve over a bent surface shows the bend", "[trim]") {
  const NurbsSurface surface = lying_half_cylinder();
  const auto straight = [](const Vector2& from, const Vector2& to) {
    return engine::bezier_chain({1, {0, 0, 1, 1}, {{from.x(), from.y(), 0, 1}, {to.x(), to.y(), 0, 1}}});
  };
  // Over the top: both ends lie in the plane z = 0, the curve does not.
  const auto over = engine::edge_samples(surface, straight({0, 0.5}, {1, 0.5}), 1e-3);
  CHECK(highest(over) == Approx(5.0).margin(1e-9));
  // Along the cylinder it is straight.
  CHECK(engine::edge_samples(surface, straight({0.3, 0}, {0.3, 1}), 1e-3).size() == 2);
}

TEST_CASE("edge samples: the highest and lowest points are among them", "[trim]") {
  const engine::Surface plane = trimmed_plane({0, 0, 0}, {10, 0, 0}, {1, 0, 10}, 0.0, {});
  const engine::TrimLoop circle = circle_loop({0.5, 0.5}, 0.3, false);
  NurbsCurve turned = circle.curves.front();
  // The loop's joint and its knots away from the extremes.
  for (auto& point : turned.control_points) {
    const Vector2 from = point.head<2>() / point.w() - Vector2(0.5, 0.5);
    const Vector2 to(0.5 + std::cos(0.7) * from.x() - std::sin(0.7) * from.y(),
                     0.5 + std::sin(0.7) * from.x() + std::cos(0.7) * from.y());
    point.head<2>() = point.w() * to;
  }
  const auto samples = engine::edge_samples(plane.nurbs, engine::bezier_chain(turned), 1e-2);
  CHECK(highest(samples) == Approx(8.0).margin(1e-9));
}

TEST_CASE("a trim region's edge that arches over a plane does not lie in it", "[trim]") {
  engine::Surface surface;
  surface.nurbs = lying_half_cylinder();
  surface.trim = {polygon_loop({{0, 0}, {1, 0}, {1, 1}, {0, 1}})};
  const engine::TrimRegion region(surface, 0);
  CHECK(region.edges_in_plane(0.0).size() == 2);
  CHECK(region.z_max() == Approx(5.0).margin(1e-9));
}

}  // namespace lamina::tests
