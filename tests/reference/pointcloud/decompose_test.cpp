#include "tests/reference/pointcloud/decompose.h"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "engine/geometry/bspline_basis.h"
#include "tests/support/analytic_models.h"
#include "tests/support/random_nurbs.h"

namespace lamina::tests {

using engine::BezierPatch;
using engine::NurbsSurface;
using engine::Vector3;
using reference::Extent;

TEST_CASE("the extent of a net is the length of its longest row and column", "[decompose]") {
  const NurbsSurface patch = bilinear({0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {3, 4, 0});
  const Extent extent = reference::net_extent(patch.net);
  CHECK(extent.u == Approx(std::hypot(3.0, 2.0)));  // from (0, 2) to (3, 4) the longer of the two
  CHECK(extent.v == Approx(4.0));
}

TEST_CASE("a surface's extent is that of its net after one refinement", "[decompose]") {
  // A quadratic Bezier arc with weights one: refined at 1/2 its control polygon is known.
  NurbsSurface surface;
  surface.degree_u = 2;
  surface.degree_v = 1;
  surface.knots_u = {0, 0, 0, 1, 1, 1};
  surface.knots_v = {0, 0, 1, 1};
  surface.net.count_u = 3;
  surface.net.count_v = 2;
  for (const Vector3& point : {Vector3(0, 0, 0), Vector3(1, 0, 2), Vector3(2, 0, 0)}) {
    surface.net.points.push_back(engine::homogeneous(point));
    surface.net.points.push_back(engine::homogeneous(point + Vector3(0, 5, 0)));
  }
  const Extent extent = reference::surface_extent(surface);
  // The control points become (0,0) (.5,1) (1.5,1) (2,0): one knot at full multiplicity less one.
  CHECK(extent.u == Approx(2 * std::hypot(0.5, 1.0) + 1.0));
  CHECK(extent.v == Approx(5.0));
}

TEST_CASE("knots per span follow the band rule", "[decompose]") {
  // k = floor(L / (n B) + 1/2), dissertation p. 122.
  CHECK(reference::inserted_knots_per_span(6.0, 1, 0.6) == 10);
  CHECK(reference::inserted_knots_per_span(6.0, 4, 0.6) == 3);  // 2.5 + 0.5
  CHECK(reference::inserted_knots_per_span(5.9, 4, 0.6) == 2);  // 2.458 + 0.5
  CHECK(reference::inserted_knots_per_span(0.29, 1, 0.6) == 0);
  CHECK(reference::inserted_knots_per_span(0.31, 1, 0.6) == 1);
  CHECK(reference::inserted_knots_per_span(0.0, 3, 0.6) == 0);
}

TEST_CASE("the number of patches is that of the band rule", "[decompose]") {
  // 12 x 4 mm in one span: k_u = floor(12 / 0.6 + 0.5) = 20, k_v = floor(4 / 0.6 + 0.5) = 7.
  const engine::Model plate = model_of("plate", {bilinear({0, 0, 0}, {12, 0, 0}, {0, 4, 0}, {12, 4, 0})});
  CHECK(reference::decompose(plate, {0.2, 3}).size() == std::size_t{21} * 8);
  CHECK(reference::decompose(plate, {0.2, 6}).size() == std::size_t{11} * 4);
  CHECK(reference::decompose(plate, {100.0, 3}).size() == 1);
}

TEST_CASE("patches come out near the size of the band", "[decompose]") {
  const engine::Model ball = sphere({0, 0, 0}, 4.0).model;
  for (const double layer_thickness : {0.1, 0.2, 0.5}) {
    const double band = 3.0 * layer_thickness;
    const std::vector<BezierPatch> patches = reference::decompose(ball, {layer_thickness, 3});
    double sum = 0.0;
    for (const BezierPatch& patch : patches) {
      const Extent extent = reference::net_extent(patch.net);
      CHECK(extent.u <= 1.5 * band);
      CHECK(extent.v <= 1.5 * band);
      sum += extent.v;
    }
    // Along a meridian nothing shrinks: k knots make k + 1 patches of L / (k + 1), at least half of the band.
    CAPTURE(layer_thickness);
    CHECK(sum / static_cast<double>(patches.size()) >= 0.5 * band);
  }
}

TEST_CASE("the patches together are the surface", "[decompose]") {
  std::mt19937 random(kRandomNurbsSeed);
  CAPTURE(kRandomNurbsSeed);
  const NurbsSurface surface = random_surface(3, 2, random);
  const reference::DecomposeOptions options{0.8, 3};
  const std::vector<BezierPatch> patches = reference::decompose(model_of("random", {surface}), options);
  // Even cuts of every span: count them by the printed rule, then map each patch onto its part of the domain.
  const auto breaks_u = engine::break_points(surface.knots_u, 3);
  const auto breaks_v = engine::break_points(surface.knots_v, 2);
  const Extent extent = reference::surface_extent(surface);
  const auto cuts = [&](double length, std::size_t spans) {
    return static_cast<std::size_t>(std::floor(length / static_cast<double>(spans) / 2.4 + 0.5)) + 1;
  };
  const std::size_t cuts_u = cuts(extent.u, breaks_u.size() - 1);
  const std::size_t cuts_v = cuts(extent.v, breaks_v.size() - 1);
  const std::size_t rows_v = cuts_v * (breaks_v.size() - 1);
  REQUIRE(cuts_u > 1);
  REQUIRE(patches.size() == cuts_u * (breaks_u.size() - 1) * rows_v);
  const auto parameter = [](const std::vector<double>& breaks, std::size_t parts, std::size_t k, double t) {
    const std::size_t span = k / parts;
    return breaks[span] + (breaks[span + 1] - breaks[span]) * (static_cast<double>(k % parts) + t) /
                              static_cast<double>(parts);
  };
  for (std::size_t k = 0; k < patches.size(); ++k) {
    for (const double t : {0.0, 0.4, 1.0}) {
      const double u = parameter(breaks_u, cuts_u, k / rows_v, t);
      const double v = parameter(breaks_v, cuts_v, k % rows_v, 0.7);
      CHECK((engine::evaluate(patches[k], t, 0.7) - engine::evaluate(surface, u, v)).norm() < 1e-9);
    }
  }
}

TEST_CASE("decompose refuses options out of range", "[decompose]") {
  CHECK_THROWS_AS(reference::decompose({}, {0.0, 3}), std::invalid_argument);
  CHECK_THROWS_AS(reference::decompose({}, {-1.0, 3}), std::invalid_argument);
  CHECK_THROWS_AS(reference::decompose({}, {0.2, 1}), std::invalid_argument);
}

}  // namespace lamina::tests
