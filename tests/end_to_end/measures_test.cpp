// The measurements of tools/bench measure right: against closed forms.

#include <cmath>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/slicer.h"
#include "tests/support/analytic_models.h"
#include "tools/bench/contour_distance.h"
#include "tools/bench/layer_bytes.h"
#include "tools/bench/slice_run.h"
#include "tools/bench/surface_distance.h"
#include "tools/bench/true_section.h"
#include "tools/bench/true_union.h"

using namespace lamina;
using engine::Vector2;
using engine::Vector3;
using std::numbers::pi;

namespace {

engine::Layer layer_at(const engine::Model& model, double z, double epsilon) {
  engine::SliceOptions options;
  options.epsilon = epsilon;
  return *engine::Slicer(model, {{z, z, z}}, options).next();
}

}  // namespace

TEST_CASE("the distance to a sphere is what a point lacks to its radius", "[bench]") {
  tools::SurfaceDistance surfaces(tests::sphere({1, 2, 10}, 5.0).model);
  surfaces.select_plane(12.0, 3.0);
  for (const double off : {-0.5, -0.01, 0.0, 0.003, 0.7}) {
    for (double angle = 0.0; angle < 2.0 * pi; angle += 0.37) {
      const Vector3 radial =
          Vector3(std::cos(angle) * std::sqrt(21.0), std::sin(angle) * std::sqrt(21.0), 2.0);
      const Vector3 place = Vector3(1, 2, 10) + (1.0 + off / 5.0) * radial;
      CHECK(surfaces.distance(place, {}) == Approx(std::abs(off)).margin(2e-6));
    }
  }
}

TEST_CASE("the true section of a torus lies on its circles and leaves no part of them out", "[bench]") {
  tools::TrueSectioner sectioner(tests::flat_torus({0, 0, 5}, 15.0, 5.0).model, 3);
  const double half = std::sqrt(25.0 - 4.0);
  const tools::TrueSection section = sectioner.at(7.0, 0.5);
  std::vector<double> angles[2];
  for (const Vector2& point : section.crossings) {
    const double radius = point.norm();
    CHECK(std::min(std::abs(radius - 15.0 - half), std::abs(radius - 15.0 + half)) < 1e-6);
    angles[radius > 15.0 ? 1 : 0].push_back(std::atan2(point.y(), point.x()));
  }
  for (std::vector<double>& circle : angles) {
    REQUIRE(circle.size() > 100);
    std::sort(circle.begin(), circle.end());
    double widest = circle.front() + 2.0 * pi - circle.back();
    for (std::size_t k = 1; k < circle.size(); ++k) widest = std::max(widest, circle[k] - circle[k - 1]);
    CHECK(widest * 20.0 < 1.5);
  }
  // Outside, in the ring, in the hole.
  CHECK(std::abs(tools::winding_number(section, {25, 0})) < 1e-6);
  CHECK(std::abs(tools::winding_number(section, {0, 15})) == Approx(1.0));
  CHECK(std::abs(tools::winding_number(section, {1, 0})) < 1e-6);
}

TEST_CASE("the true union of two spheres has the closed form's area", "[bench]") {
  const std::vector<engine::Model> parts{tests::sphere({-4, 0, 8}, 8.0).model,
                                         tests::sphere({4, 0, 8}, 8.0).model};
  const auto regions = tools::true_regions(parts, 6.5, 0.05);
  REQUIRE(regions);
  const engine::Region whole = tools::true_union(*regions, 1e-4);
  REQUIRE(whole.size() == 1);
  const double radius = std::sqrt(64.0 - 2.25);
  const double half_angle = std::acos(4.0 / radius);
  const double lens = 2.0 * radius * radius * (half_angle - std::sin(half_angle) * std::cos(half_angle));
  CHECK(engine::area(whole) == Approx(2.0 * pi * radius * radius - lens).epsilon(1e-4));
}

TEST_CASE("a solid inside another is part of the union, but a cavity by parity", "[bench]") {
  const std::vector<engine::Model> parts{tests::box({0, 0, 0}, {10, 10, 10}).model,
                                         tests::box({4, 4, 4}, {6, 6, 6}).model};
  const auto regions = tools::true_regions(parts, 5.0, 0.5);
  REQUIRE(regions);
  CHECK(engine::area(tools::true_union(*regions, 1e-4)) == Approx(100.0));
  CHECK(engine::area(tools::true_nesting(*regions, 1e-4)) == Approx(96.0));
}

TEST_CASE("distances to a square's contour, and what its faces cover", "[bench]") {
  const engine::Model square = tests::box({0, 0, 0}, {10, 10, 5}).model;
  const tools::ContourDistance contours(layer_at(square, 2.0, 0.05), 1e-4);
  CHECK(contours.distance({5, 3}, 0.0) == Approx(3.0));
  CHECK(contours.distance({-3, -4}, 0.0) == Approx(5.0));
  CHECK_FALSE(contours.in_face({5, 5}));
  const tools::ContourDistance bottom(layer_at(square, 0.0, 0.05), 1e-4);
  CHECK(bottom.in_face({5, 5}));
  CHECK_FALSE(bottom.in_face({11, 5}));
}

TEST_CASE("a layer's bytes tell the last bit of a point", "[bench]") {
  const engine::Model model = tests::standing_torus({0, 0, 20}, 15.0, 5.0).model;
  const engine::Layer layer = layer_at(model, 17.0, 0.05);
  engine::Layer other = layer;
  CHECK(tools::bytes_of(layer) == tools::bytes_of(other));
  auto& spline = std::get<engine::PlanarCurve>(other.closed.front().curve.pieces.front());
  double& x = spline.control_points[1].x();
  x = std::nextafter(x, 1e9);
  CHECK(tools::bytes_of(layer) != tools::bytes_of(other));
}

TEST_CASE("an exponent is found in values that have one", "[bench]") {
  std::vector<double> sizes{1, 3, 10, 50};
  std::vector<double> values;
  for (const double size : sizes) values.push_back(4.2 * std::pow(size, 1.25));
  CHECK(tools::fitted_exponent(sizes, values) == Approx(1.25));
}
