// Triangles through the same engine: sections of meshes against closed forms, unrepaired meshes against clean
// ones.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

#include "engine/slicer.h"
#include "tests/support/contour_measure.h"
#include "tests/support/mesh_models.h"

namespace lamina::tests {
namespace {

using engine::Layer;
using engine::Model;
using engine::TriangleMesh;

constexpr double kEpsilon = 0.05;
constexpr unsigned kSeed = 7;

Layer layer_at(const Model& model, double z) {
  engine::SliceOptions options;
  options.epsilon = kEpsilon;
  return *engine::Slicer(model, {{z, z, z}}, options).next();
}

double area_at(const Model& model, double z) {
  return parity_area(closed_loops(layer_at(model, z), 0.01 * kEpsilon));
}

TEST_CASE("a box of triangles has the section of the box", "[slicing][facets]") {
  const Model model = model_of("box", {box_mesh({0, 0, 0}, {20, 10, 5})});
  for (const double z : {0.001, 2.5, 4.999}) {
    const Layer layer = layer_at(model, z);
    REQUIRE(layer.closed.size() == 1);
    CHECK(layer.open.empty());
    CHECK(area_at(model, z) == Approx(200.0).epsilon(1e-9));
    // Four straight sides, however many triangles they are made of.
    CHECK(layer.closed.front().curve.pieces.size() == 4);
  }
  for (const double z : {0.0, 5.0}) {
    const Layer layer = layer_at(model, z);
    REQUIRE(layer.planar.size() == 1);
    CHECK(layer.planar.front().inner.empty());
    CHECK(std::abs(engine::signed_area(layer.planar.front().outer)) == Approx(200.0).epsilon(1e-9));
  }
}

TEST_CASE("a fine sphere mesh has the sections of its polyhedron, at any height", "[slicing][facets]") {
  const int rings = 90;
  const int sides = 180;
  const double radius = 10.0;
  const Model model = model_of("sphere", {sphere_mesh({0, 0, 0}, radius, rings, sides)});
  // Between the inscribed polyhedron and the sphere: relative loss of area below (pi / sides)^2 + (pi / 2
  // rings)^2.
  const double loss = std::pow(std::numbers::pi / sides, 2) + std::pow(std::numbers::pi / (2.0 * rings), 2);
  for (double z = -9.5; z < 9.6; z += 0.61) {
    const Layer layer = layer_at(model, z);
    CAPTURE(z);
    REQUIRE(layer.closed.size() == 1);
    CHECK(layer.open.empty());
    const double area = parity_area(closed_loops(layer, 0.01 * kEpsilon));
    const double disc = std::numbers::pi * (radius * radius - z * z);
    CHECK(area <= disc + 0.1 * kEpsilon * 2.0 * std::numbers::pi * radius);
    CHECK(area >= disc - loss * std::numbers::pi * radius * radius -
                      0.1 * kEpsilon * 2.0 * std::numbers::pi * radius);
  }
  // Exactly through rings of vertices.
  for (int k = 5; k < rings - 5; k += 8) {
    const auto z = static_cast<double>(static_cast<float>(-radius * std::cos(std::numbers::pi * k / rings)));
    const double sine = std::sin(std::numbers::pi * k / rings);
    const double polygon =
        0.5 * sides * radius * radius * sine * sine * std::sin(2.0 * std::numbers::pi / sides);
    const Layer layer = layer_at(model, z);
    CAPTURE(z);
    REQUIRE(layer.closed.size() == 1);
    CHECK_FALSE(layer.closed.front().touch);
    CHECK(parity_area(closed_loops(layer, 0.01 * kEpsilon)) == Approx(polygon).epsilon(2e-4));
  }
}

TEST_CASE("normals at random and facets twice change nothing", "[slicing][facets]") {
  INFO("seed " << kSeed);
  std::mt19937 random(kSeed);
  const TriangleMesh clean = sphere_mesh({0, 0, 0}, 5.0, 40, 80);
  TriangleMesh sloppy = clean;
  for (auto& facet : sloppy.facets) {
    if (random() % 2 == 0) std::swap(facet[1], facet[2]);
  }
  for (std::size_t k = 0; k < clean.facets.size(); k += 7) sloppy.facets.push_back(clean.facets[k]);
  // Degenerate ones, too.
  sloppy.facets.push_back({0, 0, 1});
  sloppy.facets.push_back({200, 200, 200});
  const Model a = model_of("clean", {clean});
  const Model b = model_of("sloppy", {sloppy});
  for (double z = -4.7; z < 4.8; z += 0.37) {
    CAPTURE(z);
    CHECK(layer_at(b, z).open.empty());
    CHECK(area_at(b, z) == Approx(area_at(a, z)).epsilon(0.005));
  }
}

TEST_CASE("gaps below epsilon vanish", "[slicing][facets]") {
  INFO("seed " << kSeed);
  std::mt19937 random(kSeed);
  // Facets about 0.04 mm wide; one in a hundred is deleted.
  const TriangleMesh clean = sphere_mesh({0, 0, 0}, 1.0, 80, 160);
  TriangleMesh holed = clean;
  std::erase_if(holed.facets, [&](const auto&) { return random() % 100 == 0; });
  REQUIRE(holed.facets.size() < clean.facets.size());
  const Model a = model_of("clean", {clean});
  const Model b = model_of("holed", {holed});
  for (double z = -0.93; z < 0.95; z += 0.07) {
    CAPTURE(z);
    const Layer layer = layer_at(b, z);
    CHECK(layer.open.empty());
    CHECK(layer.closed.size() == 1);
    CHECK(area_at(b, z) == Approx(area_at(a, z)).epsilon(0.005));
  }
}

TriangleMesh turned_over(TriangleMesh mesh) {
  for (auto& facet : mesh.facets) std::swap(facet[1], facet[2]);
  return mesh;
}

TEST_CASE("a hole that another solid runs into is filled only where that solid is", "[slicing][facets]") {
  const TriangleMesh plate = box_mesh({0, 0, 0}, {10, 10, 5});
  const TriangleMesh hole = turned_over(box_mesh({3, 3, 0}, {7, 7, 5}));
  const TriangleMesh rib = box_mesh({5, 4, -1}, {12, 6, 6});
  const double area = 100.0 - 16.0 + 4.0 + 4.0;
  CHECK(area_at(model_of("plate and rib", {plate, hole, rib}), 2.0) == Approx(area).epsilon(1e-6));
  // The same where all normals of the file point inwards.
  const Model inwards = model_of("inwards", {turned_over(plate), turned_over(hole), turned_over(rib)});
  CHECK(area_at(inwards, 2.0) == Approx(area).epsilon(1e-6));
  // Where the normals contradict each other the hole may as well be a solid.
  CHECK(area_at(model_of("contrary", {plate, hole, turned_over(rib)}), 2.0) == Approx(104.0).epsilon(1e-6));
}

TEST_CASE("a solid turned inside out is no hole of those that it crosses", "[slicing][facets]") {
  const TriangleMesh left = box_mesh({0, 0, 0}, {10, 10, 5});
  const TriangleMesh right = box_mesh({8, 0, 0}, {15, 10, 5});
  const TriangleMesh inner = turned_over(box_mesh({4, 3, 0}, {12, 7, 5}));
  CHECK(area_at(model_of("three boxes", {left, right, inner}), 2.0) == Approx(150.0).epsilon(1e-6));
}

TEST_CASE("a fin stays an open contour and is not bent back to the wall that it stands on",
          "[slicing][facets]") {
  TriangleMesh box = box_mesh({0, 0, 0}, {20, 10, 5});
  const auto first = static_cast<std::uint32_t>(box.vertices.size());
  // Slanting, so that its free edge is near the wall: 0.24 mm at z = 2.
  box.vertices.insert(box.vertices.end(), {{7, 0, 0}, {7, 0, 5}, {7.3F, -0.3F, 2.5F}});
  box.facets.push_back({first, first + 1, first + 2});
  const Model model = model_of("box with a fin", {box});
  const Layer layer = layer_at(model, 2.0);
  REQUIRE(layer.closed.size() == 1);
  CHECK(area_at(model, 2.0) == Approx(200.0).epsilon(1e-9));
  REQUIRE(layer.open.size() == 1);
  CHECK(engine::length(layer.open.front().curve) == Approx(std::sqrt(2.0) * 0.24).epsilon(1e-6));
  CHECK(layer.report.bridged_gaps.empty());
}

TEST_CASE("meshes that overlap give their union, with solids of surfaces as well", "[slicing][facets]") {
  Model model = model_of("two boxes", {box_mesh({0, 0, 0}, {10, 10, 5}), box_mesh({5, 5, 0}, {15, 15, 5})});
  CHECK(area_at(model, 2.0) == Approx(175.0).epsilon(1e-6));
  // An inner shell is a cavity.
  const Model shell = model_of("shell", {box_mesh({0, 0, 0}, {10, 10, 10}), box_mesh({2, 2, 2}, {8, 8, 8})});
  CHECK(area_at(shell, 5.0) == Approx(100.0 - 36.0).epsilon(1e-6));
}

}  // namespace
}  // namespace lamina::tests
