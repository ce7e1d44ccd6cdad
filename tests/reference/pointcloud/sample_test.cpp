#include "tests/reference/pointcloud/sample.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "tests/reference/pointcloud/decompose.h"
#include "tests/support/analytic_models.h"
#include "tests/support/random_nurbs.h"

namespace lamina::tests {
namespace {

using engine::BezierPatch;
using engine::Vector3;

/// Distance of a point from the nearest sample.
double distance_to(const std::vector<Vector3>& points, const Vector3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3& other : points) least = std::min(least, (point - other).squaredNorm());
  return std::sqrt(least);
}

/// The greatest distance of any point of the patch, taken densely, from the nearest sample.
double covering_radius(const BezierPatch& patch, const std::vector<Vector3>& points) {
  double greatest = 0.0;
  for (int i = 0; i <= 60; ++i) {
    for (int j = 0; j <= 60; ++j) {
      greatest = std::max(greatest, distance_to(points, engine::evaluate(patch, i / 60.0, j / 60.0)));
    }
  }
  return greatest;
}

/// Whether the quad and all quads it was divided into pass the six-distance test with points that were
/// sampled.
bool six_distances_hold(const BezierPatch& patch, const std::vector<Vector3>& points, double u0, double u1,
                        double v0, double v1, double epsilon) {
  const Vector3 corners[4] = {engine::evaluate(patch, u0, v0), engine::evaluate(patch, u1, v0),
                              engine::evaluate(patch, u0, v1), engine::evaluate(patch, u1, v1)};
  bool within = true;
  for (int a = 0; a < 4; ++a) {
    if (distance_to(points, corners[a]) > 1e-9) return false;  // a corner that is no sample
    for (int b = a + 1; b < 4; ++b) within = within && (corners[a] - corners[b]).norm() <= epsilon;
  }
  if (within) return true;
  const double u = 0.5 * (u0 + u1);
  const double v = 0.5 * (v0 + v1);
  return six_distances_hold(patch, points, u0, u, v0, v, epsilon) &&
         six_distances_hold(patch, points, u, u1, v0, v, epsilon) &&
         six_distances_hold(patch, points, u0, u, v, v1, epsilon) &&
         six_distances_hold(patch, points, u, u1, v, v1, epsilon);
}

/// A quadratic strip whose points crowd at one end: even parameters are not even distances.
BezierPatch crowded_patch() {
  BezierPatch patch;
  patch.degree_u = 2;
  patch.degree_v = 1;
  patch.net.count_u = 3;
  patch.net.count_v = 2;
  for (const double x : {0.0, 0.02, 1.0}) {
    for (const double y : {0.0, 0.6}) patch.net.points.push_back(engine::homogeneous({x, y, 0.3 * x}));
  }
  return patch;
}

}  // namespace

TEST_CASE("a flat patch gets the even grid of the printed formula", "[sample]") {
  // N = extent * C_over / epsilon intervals each way.
  const BezierPatch patch =
      engine::bezier_patches(bilinear({0, 0, 0}, {1, 0, 0}, {0, 0.5, 0}, {1, 0.5, 0})).front();
  CHECK(reference::sample(patch, {0.1, 2.0}).size() == std::size_t{21} * 11);
  CHECK(reference::sample(patch, {0.1, 4.0}).size() == std::size_t{41} * 21);
  // Without over-sampling the sides are epsilon but the diagonal is not: every quad is quartered once, and
  // each stores the five new points.
  CHECK(reference::sample(patch, {0.1, 1.0}).size() == std::size_t{11} * 6 + std::size_t{5} * 10 * 5);
}

TEST_CASE("every quad of samples passes the six-distance test", "[sample]") {
  const double epsilon = 0.1;
  for (const double oversampling : {1.0, 2.0}) {
    std::vector<BezierPatch> patches = reference::decompose(sphere({0, 0, 0}, 1.0).model, {0.2, 3});
    patches.resize(8);
    patches.push_back(crowded_patch());
    for (const BezierPatch& patch : patches) {
      const std::vector<Vector3> points = reference::sample(patch, {epsilon, oversampling});
      const reference::Extent extent = reference::net_extent(patch.net);
      const auto count = [&](double length) {
        return std::max(1.0, std::ceil(length * oversampling / epsilon));
      };
      const double count_u = count(extent.u);
      const double count_v = count(extent.v);
      for (double i = 0; i < count_u; ++i) {
        for (double j = 0; j < count_v; ++j) {
          CHECK(six_distances_hold(patch, points, i / count_u, (i + 1) / count_u, j / count_v,
                                   (j + 1) / count_v, epsilon));
        }
      }
    }
  }
}

TEST_CASE("no point of a patch is farther than epsilon from a sample", "[sample]") {
  std::mt19937 random(kRandomNurbsSeed);
  CAPTURE(kRandomNurbsSeed);
  std::vector<BezierPatch> patches =
      reference::decompose(model_of("random", {random_surface(2, 3, random)}), {0.3, 3});
  patches.resize(std::min<std::size_t>(patches.size(), 10));
  patches.push_back(crowded_patch());
  for (const BezierPatch& patch : patches) {
    for (const double epsilon : {0.2, 0.1}) {
      // The centre of a flat quad with sides and diagonals up to epsilon is at most epsilon / sqrt(2) from a
      // corner; a curved one bulges by less than the rest.
      CHECK(covering_radius(patch, reference::sample(patch, {epsilon, 1.0})) <= epsilon);
      CHECK(covering_radius(patch, reference::sample(patch, {epsilon, 2.0})) <= 0.75 * epsilon);
    }
  }
}

TEST_CASE("every sample lies on the surface", "[sample]") {
  const Vector3 centre(1, 2, 3);
  for (const BezierPatch& patch : reference::decompose(sphere(centre, 2.0).model, {0.3, 3})) {
    for (const Vector3& point : reference::sample(patch, {0.1, 2.0})) {
      REQUIRE((point - centre).norm() == Approx(2.0).epsilon(1e-12));
    }
  }
}

TEST_CASE("a patch smaller than epsilon is sampled at its corners", "[sample]") {
  const BezierPatch patch =
      engine::bezier_patches(bilinear({0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0.01, 0.01, 0})).front();
  CHECK(reference::sample(patch, {0.1, 2.0}).size() == 4);
}

TEST_CASE("a patch that shrinks to a point is sampled", "[sample]") {
  const BezierPatch patch =
      engine::bezier_patches(bilinear({1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3})).front();
  const std::vector<Vector3> points = reference::sample(patch, {0.1, 2.0});
  REQUIRE_FALSE(points.empty());
  for (const Vector3& point : points) CHECK((point - Vector3(1, 2, 3)).norm() < 1e-12);
}

}  // namespace lamina::tests
