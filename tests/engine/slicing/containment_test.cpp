// Layers that contain, or are contained in, every section of their slab: against closed forms and against
// sections that were not used to make them.

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "engine/slicer.h"
#include "tests/support/analytic_models.h"
#include "tests/support/contour_measure.h"

namespace lamina::tests {
namespace {

using engine::Containment;
using engine::Layer;
using engine::Loop;
using engine::SlicePlane;
using engine::Vector2;

constexpr double kEpsilon = 0.02;

Layer layer_of(const engine::Model& model, const SlicePlane& plane, Containment containment) {
  engine::SliceOptions options;
  options.epsilon = kEpsilon;
  options.containment = containment;
  return *engine::Slicer(model, {plane}, options).next();
}

double area_of(const Layer& layer) {
  return parity_area(closed_loops(layer, 0.01 * kEpsilon));
}

double signed_distance(const std::vector<Loop>& loops, const Vector2& point) {
  double distance = polyline_section(loops).distance(point);
  bool inside = false;
  for (const Loop& loop : loops) {
    for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
      const Vector2& a = loop[i];
      const Vector2& b = loop[j];
      if ((a.y() > point.y()) != (b.y() > point.y()) &&
          point.x() < (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y()) + a.x())
        inside = !inside;
    }
  }
  return inside ? -distance : distance;
}

TEST_CASE("slabs of a sphere: the greatest and the smallest disc", "[slicing][containment]") {
  const AnalyticModel solid = sphere({1, 2, 0}, 5.0);
  const auto disc = [](double z) { return std::numbers::pi * (25.0 - z * z); };
  for (const auto& [bottom, top] : {std::pair{-3.0, -2.5}, std::pair{-0.3, 0.2}, std::pair{2.0, 2.4}}) {
    const SlicePlane plane{0.5 * (bottom + top), bottom, top};
    const double widest = bottom * top < 0.0 ? 0.0 : std::min(std::abs(bottom), std::abs(top));
    const double narrowest = std::max(std::abs(bottom), std::abs(top));
    CAPTURE(bottom, top);
    const double bound = 31.5 * 0.1 * kEpsilon;
    CHECK(area_of(layer_of(solid.model, plane, Containment::kPositive)) ==
          Approx(disc(widest)).margin(bound));
    CHECK(area_of(layer_of(solid.model, plane, Containment::kNegative)) ==
          Approx(disc(narrowest)).margin(bound));
    CHECK(area_of(layer_of(solid.model, plane, Containment::kNominal)) ==
          Approx(disc(plane.z)).margin(bound));
  }
}

TEST_CASE("a slab that the solid ends in: all of it or none", "[slicing][containment]") {
  const engine::Model model = box({0, 0, 0}, {10, 10, 3.05}).model;
  const SlicePlane plane{3.1, 3.0, 3.2};
  CHECK(area_of(layer_of(model, plane, Containment::kNominal)) == 0.0);
  CHECK(area_of(layer_of(model, plane, Containment::kPositive)) == Approx(100.0).margin(1e-4));
  CHECK(area_of(layer_of(model, plane, Containment::kNegative)) == 0.0);
  const SlicePlane below{2.9, 2.8, 3.0};
  for (const Containment containment : {Containment::kPositive, Containment::kNegative})
    CHECK(area_of(layer_of(model, below, containment)) == Approx(100.0).margin(1e-4));
}

TEST_CASE("a plate thinner than the distance of the slab's sections is not missed",
          "[slicing][containment]") {
  const engine::Model model = box({0, 0, 3.004}, {10, 10, 3.012}).model;
  CHECK(area_of(layer_of(model, {3.1, 3.0, 3.2}, Containment::kPositive)) == Approx(100.0).margin(1e-4));
  CHECK(area_of(layer_of(model, {3.1, 3.0, 3.2}, Containment::kNegative)) == 0.0);
}

TEST_CASE("every section of the slab lies between the negative and the positive layer",
          "[slicing][containment]") {
  const AnalyticModel torus = standing_torus({0, 0, 20}, 12.0, 4.0);
  const AnalyticModel lying = box_with_hole({0, 0, 0}, {20, 15, 10}, 4.0);
  const engine::Model tilted = engine::transformed(
      lying.model, Eigen::Affine3d(Eigen::AngleAxisd(0.5, engine::Vector3(1, 1, 0).normalized())));
  for (const engine::Model& model : {torus.model, tilted}) {
    for (const double bottom : {2.0, 4.4, 6.0}) {
      const SlicePlane plane{bottom + 0.15, bottom, bottom + 0.3};
      const auto outer = closed_loops(layer_of(model, plane, Containment::kPositive), 0.01 * kEpsilon);
      const auto inner = closed_loops(layer_of(model, plane, Containment::kNegative), 0.01 * kEpsilon);
      for (const double part : {0.07, 0.31, 0.5, 0.83}) {
        const double z = bottom + 0.3 * part;
        const Layer section = layer_of(model, {z, z, z}, Containment::kNominal);
        CAPTURE(model.name, z);
        for (const Loop& loop : closed_loops(section, 0.01 * kEpsilon)) {
          for (const Vector2& point : loop) {
            CHECK(signed_distance(outer, point) < 0.2 * kEpsilon);
            CHECK(signed_distance(inner, point) > -0.2 * kEpsilon);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace lamina::tests
