// Scanned points through the same engine: sections of spheres and tori, sampled at random, against closed
// forms; holes, noise, outliers, and scans that are too sparse.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "engine/slicer.h"
#include "tests/support/contour_measure.h"
#include "tests/support/scan_models.h"

namespace lamina::tests {
namespace {

using engine::Layer;
using engine::Loop;
using engine::Model;
using engine::Vector2;
using engine::Vector3;

constexpr double kPi = std::numbers::pi;

Layer layer_at(const Model& model, double z, double epsilon, double longest_bridge = 2.0) {
  engine::SliceOptions options;
  options.epsilon = epsilon;
  options.longest_bridge = longest_bridge;
  return *engine::Slicer(model, {{z, z, z}}, options).next();
}

/// Largest distance of the loops' points from circles around the origin of any of these radii.
double off_circles(const std::vector<Loop>& loops, const std::vector<double>& radii) {
  double largest = 0.0;
  for (const Loop& loop : loops) {
    for (const Vector2& point : loop) {
      double nearest = 1e9;
      for (const double radius : radii) nearest = std::min(nearest, std::abs(point.norm() - radius));
      largest = std::max(largest, nearest);
    }
  }
  return largest;
}

TEST_CASE("the spacing of points at random is found", "[slicing][scan]") {
  for (const double spacing : {0.3, 0.6}) {
    ScanSampling sampling;
    sampling.spacing = spacing;
    const auto prepared = engine::prepare_scan(scanned_sphere({0, 0, 0}, 10.0, sampling));
    std::vector<float> spacings = prepared.cloud.spacings;
    std::nth_element(spacings.begin(), spacings.begin() + spacings.size() / 2, spacings.end());
    CAPTURE(spacing);
    // Eight neighbours know the density to 1 / sqrt(8), nine times averaged; 19 of 20 lie within twice that.
    CHECK(spacings[spacings.size() / 2] == Approx(spacing).epsilon(0.06));
    CHECK(prepared.cloud.spacing > spacing);
    CHECK(prepared.cloud.spacing < 1.35 * spacing);
    CHECK(prepared.outliers == 0);
    CHECK(prepared.repeated == 0);
    CHECK_FALSE(prepared.estimated_normals);
  }
}

TEST_CASE("sections of a scanned sphere are circles", "[slicing][scan]") {
  for (const bool with_normals : {true, false}) {
    ScanSampling sampling;
    sampling.with_normals = with_normals;
    const double radius = 10.0;
    const Model model = model_of(scanned_sphere({0, 0, 0}, radius, sampling));
    const double epsilon = engine::served_epsilon(model.clouds.front());
    CHECK(epsilon < 0.75 * sampling.spacing);
    for (double z = -9.0; z < 9.1; z += 1.37) {
      const Layer layer = layer_at(model, z, epsilon);
      CAPTURE(with_normals, z, epsilon);
      REQUIRE(layer.closed.size() == 1);
      CHECK(layer.open.empty());
      CHECK(layer.report.bridged_gaps.empty());
      const auto loops = closed_loops(layer, 0.01 * epsilon);
      const double section = std::sqrt(radius * radius - z * z);
      // Spheres are met exactly where the normals are exact: chords and fit are within a tenth of epsilon.
      // The normals of planes through 17 points are off by their bend, which a sphere shares all around. A
      // distance from the sphere is more within a plane that meets it at a slant.
      const double slant = radius / section;
      CHECK(off_circles(loops, {section}) <= (with_normals ? 0.1 : 0.4) * epsilon * slant);
      CHECK(parity_area(loops) ==
            Approx(kPi * section * section).margin(2.0 * kPi * section * 0.1 * epsilon * slant));
    }
  }
}

TEST_CASE("sections of a scanned torus are rings, or two circles", "[slicing][scan]") {
  for (const bool with_normals : {true, false}) {
    ScanSampling sampling;
    sampling.spacing = 0.4;
    sampling.with_normals = with_normals;
    const double middle = 15.0;
    const double tube = 5.0;
    const Model model = model_of(scanned_torus(middle, tube, sampling));
    const double epsilon = engine::served_epsilon(model.clouds.front());
    CHECK(epsilon < 0.75 * sampling.spacing);
    for (double z = -4.0; z < 4.1; z += 0.89) {
      const double half = std::sqrt(tube * tube - z * z);
      const Layer layer = layer_at(model, z, epsilon);
      CAPTURE(with_normals, z, epsilon);
      REQUIRE(layer.closed.size() == 2);
      CHECK(layer.open.empty());
      const auto loops = closed_loops(layer, 0.01 * epsilon);
      const double slant = tube / half;
      CHECK(off_circles(loops, {middle - half, middle + half}) <= epsilon * slant);
      const double area = 4.0 * kPi * middle * half;
      const double circumference = 4.0 * kPi * middle;
      CHECK(parity_area(loops) == Approx(area).margin(circumference * 0.2 * epsilon * slant));
      CHECK(perimeter_of(loops) == Approx(circumference).epsilon(0.01));
    }
  }
}

TEST_CASE("noise and outliers of a scan do not reach the contours", "[slicing][scan]") {
  ScanSampling sampling;
  sampling.spacing = 0.25;
  sampling.noise = 0.03;
  const double radius = 10.0;
  engine::ScannedPoints scanned = scanned_sphere({0, 0, 0}, radius, sampling);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> anywhere(-14.0F, 14.0F);
  std::size_t strays = 0;
  while (strays < 200) {
    const Eigen::Vector3f place(anywhere(random), anywhere(random), anywhere(random));
    if (std::abs(place.norm() - radius) < 1.0) continue;
    scanned.points.push_back(place);
    scanned.normals.push_back(Eigen::Vector3f::UnitX());
    ++strays;
  }
  const auto prepared = engine::prepare_scan(std::move(scanned));
  // Normal deviations beyond six sigma do not happen.
  CHECK(prepared.outliers >= strays);
  CHECK(prepared.outliers <= strays + 5);
  CHECK(prepared.cloud.noise == Approx(sampling.noise).epsilon(0.2));
  Model model;
  model.clouds.push_back(prepared.cloud);
  const double epsilon = engine::served_epsilon(prepared.cloud);
  for (const double z : {-7.0, -0.3, 5.1}) {
    const Layer layer = layer_at(model, z, epsilon);
    const double section = std::sqrt(radius * radius - z * z);
    CAPTURE(z, epsilon);
    REQUIRE(layer.closed.size() == 1);
    CHECK(layer.open.empty());
    CHECK(off_circles(closed_loops(layer, 0.01 * epsilon), {section}) <= epsilon * radius / section);
  }
}

TEST_CASE("a scan's hole is closed up to the limit and reported", "[slicing][scan]") {
  const double radius = 10.0;
  const Vector3 hole(radius, 0.0, 0.0);
  ScanSampling sampling;
  sampling.spacing = 0.25;
  sampling.hidden = [&](const Vector3& point) { return (point - hole).norm() < 0.9; };
  const Model model = model_of(scanned_sphere({0, 0, 0}, radius, sampling));
  const double epsilon = engine::served_epsilon(model.clouds.front());

  const Layer bridged = layer_at(model, 0.1, epsilon, 2.0);
  REQUIRE(bridged.closed.size() == 1);
  CHECK(bridged.open.empty());
  REQUIRE(bridged.report.bridged_gaps.size() == 1);
  const engine::BridgedGap& gap = bridged.report.bridged_gaps.front();
  CHECK((0.5 * (gap.from + gap.to) - Vector2(radius, 0.0)).norm() < 0.5);
  CHECK(gap.width() > 1.0);
  CHECK(gap.width() < 1.8 + 2.0 * sampling.spacing);
  // As the surface around it bends.
  CHECK(off_circles(closed_loops(bridged, 0.01 * epsilon), {radius}) <= epsilon);

  const Layer open = layer_at(model, 0.1, epsilon, 0.7);
  CHECK(open.closed.empty());
  CHECK(open.open.size() == 1);
  REQUIRE_FALSE(open.report.open_gaps.empty());
  CHECK(open.report.open_gaps.front().width() > 1.0);

  const Layer beside = layer_at(model, 3.0, epsilon, 2.0);
  CHECK(beside.closed.size() == 1);
  CHECK(beside.report.bridged_gaps.empty());
}

TEST_CASE("a scan that is too sparse is refused with what it serves", "[slicing][scan]") {
  const Model model = model_of(scanned_sphere({0, 0, 0}, 10.0, {}));
  const double served = engine::served_epsilon(model.clouds.front());
  std::string message;
  try {
    layer_at(model, 0.0, 0.05);
  } catch (const engine::SliceError& error) {
    message = error.what();
  }
  CAPTURE(message, served);
  REQUIRE(message.find("tolerance of 0.05 mm") != std::string::npos);
  const std::string words = "which serves ";
  const auto at = message.find(words);
  REQUIRE(at != std::string::npos);
  const double named = std::stod(message.substr(at + words.size()));
  CHECK(named >= served);
  CHECK(named <= 1.02 * served);
  CHECK_NOTHROW(layer_at(model, 0.0, named));
  CHECK_THROWS_AS(layer_at(model, 0.0, 0.98 * served), engine::SliceError);
}

TEST_CASE("thin walls of a scan keep both sides", "[slicing][scan]") {
  ScanSampling sampling;
  sampling.spacing = 0.25;
  engine::ScannedPoints scanned = scanned_sphere({0, 0, 0}, 10.0, sampling);
  sampling.seed = 3;
  // The wall is two spacings thick: within the reach of the points on either side.
  const engine::ScannedPoints inner = scanned_sphere({0, 0, 0}, 9.5, sampling);
  scanned.points.insert(scanned.points.end(), inner.points.begin(), inner.points.end());
  for (const Eigen::Vector3f& normal : inner.normals) scanned.normals.push_back(-normal);
  const Model model = model_of(std::move(scanned));
  const double epsilon = 0.2;
  for (const double z : {-5.0, 0.2, 6.0}) {
    const Layer layer = layer_at(model, z, epsilon);
    CAPTURE(z);
    REQUIRE(layer.closed.size() == 2);
    const double outside = std::sqrt(100.0 - z * z);
    const double inside = std::sqrt(9.5 * 9.5 - z * z);
    CHECK(off_circles(closed_loops(layer, 0.01 * epsilon), {outside, inside}) <= 0.2);
  }
}

TEST_CASE("moving, turning and scaling a scan moves its section", "[slicing][scan]") {
  ScanSampling sampling;
  sampling.spacing = 0.4;
  const Model model = model_of(scanned_torus(8.0, 3.0, sampling));
  const double epsilon = 0.4;
  const auto area_at = [&](const Model& of, double z, double at_epsilon) {
    return parity_area(closed_loops(layer_at(of, z, at_epsilon), 0.01 * at_epsilon));
  };
  const double area = area_at(model, 0.7, epsilon);
  const Eigen::Affine3d moved =
      Eigen::Translation3d(3.0, -7.0, 11.0) * Eigen::AngleAxisd(0.7, Vector3::UnitZ()) * Eigen::Scaling(2.0);
  CHECK(area_at(engine::transformed(model, moved), 11.0 + 1.4, 2.0 * epsilon) ==
        Approx(4.0 * area).epsilon(2e-3));
}

}  // namespace
}  // namespace lamina::tests
