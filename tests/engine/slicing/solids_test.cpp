// Assemblies: known solids are united, whatever lies in each other; what is of no known solid nests by
// parity.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "engine/import/read_model.h"
#include "engine/slicer.h"
#include "tests/support/analytic_models.h"
#include "tests/support/contour_measure.h"
#include "tests/support/corpus.h"
#include "tests/support/mesh_models.h"

namespace lamina::tests {
namespace {

using engine::Layer;
using engine::Model;
using engine::Vector3;

constexpr double kEpsilon = 0.05;
constexpr double kDisc = std::numbers::pi * 9.0;  // of radius 3

Layer layer_at(const Model& model, double z) {
  engine::SliceOptions options;
  options.epsilon = kEpsilon;
  return *engine::Slicer(model, {{z, z, z}}, options).next();
}

double area_of(const Layer& layer) {
  return parity_area(closed_loops(layer, 0.01 * kEpsilon));
}

/// All of them as one model; numbered as solids of their own, or not.
Model assembly(std::vector<Model> parts, bool known) {
  Model all;
  std::uint32_t solid = 0;
  for (Model& part : parts) {
    ++solid;
    for (engine::Surface& surface : part.surfaces) {
      surface.solid = known ? solid : 0;
      all.surfaces.push_back(std::move(surface));
    }
    for (engine::TriangleMesh& mesh : part.meshes) {
      mesh.solid = known ? solid : 0;
      all.meshes.push_back(std::move(mesh));
    }
  }
  return all;
}

Model plate_with_hole() {
  return box_with_hole({-10, -8, 0}, {10, 8, 10}, 3.0).model;
}

/// A cylinder through the plate, turned so that its nodes lie elsewhere than those of the hole.
Model bolt(double radius, double turn) {
  Eigen::Affine3d turned = Eigen::Affine3d::Identity();
  turned.rotate(Eigen::AngleAxisd(turn, Vector3::UnitZ()));
  return engine::transformed(upright_cylinder({0, 0, -2}, radius, 14).model, turned);
}

TEST_CASE("a bolt that fills its hole is material", "[slicing][solids]") {
  for (const double turn : {0.0, 0.3, 0.7854}) {
    for (const double z : {0.5, 4.7, 9.5}) {
      CAPTURE(turn, z);
      const Layer layer = layer_at(assembly({plate_with_hole(), bolt(3.0, turn)}, true), z);
      CHECK(layer.closed.size() == 1);
      CHECK(layer.open.empty());
      CHECK(area_of(layer) == Approx(320.0).epsilon(1e-6));
    }
  }
}

TEST_CASE("a bolt with play leaves a ring, and heads above the plate are there", "[slicing][solids]") {
  const Model model = assembly({plate_with_hole(), bolt(2.5, 0.0)}, true);
  const Layer inside = layer_at(model, 5.1);
  CHECK(inside.closed.size() == 3);
  // Curves are a tenth of epsilon off at most.
  const double margin = 0.1 * kEpsilon * 2.0 * std::numbers::pi * (3.0 + 2.5);
  CHECK(area_of(inside) == Approx(320.0 - kDisc + std::numbers::pi * 6.25).margin(margin));
  const Layer above = layer_at(model, 11.0);
  CHECK(above.closed.size() == 1);
  CHECK(area_of(above) == Approx(std::numbers::pi * 6.25).margin(margin));
}

TEST_CASE("a solid inside another is material, an inner shell of one solid a cavity", "[slicing][solids]") {
  const Model ball = sphere({0, 0, 5}, 3.0).model;
  const Model block = box({-10, -8, 0}, {10, 8, 10}).model;
  const Layer known = layer_at(assembly({block, ball}, true), 5.0);
  CHECK(known.closed.size() == 1);
  CHECK(area_of(known) == Approx(320.0).epsilon(1e-9));
  const Layer unknown = layer_at(assembly({block, ball}, false), 5.0);
  CHECK(unknown.closed.size() == 2);
  CHECK(area_of(unknown) == Approx(320.0 - kDisc).epsilon(1e-4));
  const Layer one = layer_at(assembly({united("hollow", {block, ball})}, true), 5.0);
  CHECK(one.closed.size() == 2);
  CHECK(area_of(one) == Approx(320.0 - kDisc).epsilon(1e-4));
}

TEST_CASE("solids that overlap or lie flush are one outline", "[slicing][solids]") {
  const Model block = box({0, 0, 0}, {10, 10, 10}).model;
  const Layer overlap = layer_at(assembly({block, box({5, 5, 0}, {15, 15, 10}).model}, true), 5.0);
  CHECK(overlap.closed.size() == 1);
  CHECK(area_of(overlap) == Approx(175.0).epsilon(1e-9));
  const Layer flush = layer_at(assembly({block, box({10, 2, 0}, {15, 7, 10}).model}, true), 5.0);
  CHECK(flush.closed.size() == 1);
  CHECK(area_of(flush) == Approx(125.0).epsilon(1e-9));
  const Layer apart = layer_at(assembly({block, box({10.5, 2, 0}, {15, 7, 10}).model}, true), 5.0);
  CHECK(apart.closed.size() == 2);
  CHECK(area_of(apart) == Approx(122.5).epsilon(1e-9));
}

TEST_CASE("a round hole that touches the plane leaves the faces around it whole", "[slicing][solids]") {
  if (!corpus_present()) {
    WARN("the model corpus is not there: skipped");
    return;
  }
  // At z = 65 two brackets of 10 x 100 mm and two nuts of 3 x 15 mm, their holes' and the rod's top.
  const Layer layer = layer_at(engine::read_model(corpus_file("real/as1-tu-203.stp")).model, 65.0);
  CHECK(area_of(layer) == Approx(2090.0).epsilon(1e-6));
}

TEST_CASE("meshes of known solids are united as surfaces are", "[slicing][solids]") {
  const auto block = [](const Vector3& low, const Vector3& high) {
    return model_of("block", {box_mesh(low, high)});
  };
  for (const bool known : {true, false}) {
    const Layer layer =
        layer_at(assembly({block({0, 0, 0}, {10, 10, 10}), block({2, 2, 2}, {8, 8, 8})}, known), 5.0);
    CHECK(layer.closed.size() == (known ? 1 : 2));
    CHECK(area_of(layer) == Approx(known ? 100.0 : 64.0).epsilon(1e-6));
  }
}

TEST_CASE("a solid whose gaps are below epsilon is one all the same", "[slicing][solids]") {
  Model block = box({-10, -8, 0}, {10, 8, 10}).model;
  Eigen::Affine3d shift = Eigen::Affine3d::Identity();
  shift.translation() = Vector3(0.02, 0.02, 0.0);
  block.surfaces.front().nurbs = transformed(block.surfaces.front().nurbs, shift);
  const Layer layer = layer_at(assembly({block, sphere({0, 0, 5}, 3.0).model}, true), 5.0);
  CHECK(layer.closed.size() == 1);
  CHECK(layer.open.empty());
  CHECK_FALSE(layer.report.bridged_gaps.empty());
  CHECK(area_of(layer) == Approx(320.0).margin(0.02 * (20.0 + 16.0)));
}

TEST_CASE("a solid that is not closed is taken with the loose surfaces", "[slicing][solids]") {
  // The block lacks a side, which a patch of no solid closes.
  Model block = box({0, 0, 0}, {10, 10, 10}).model;
  Model side;
  side.surfaces.push_back(std::move(block.surfaces.front()));
  block.surfaces.erase(block.surfaces.begin());
  Model model = assembly({block, box({12, 0, 0}, {15, 10, 10}).model}, true);
  model.surfaces.push_back(side.surfaces.front());
  const Layer layer = layer_at(model, 5.0);
  CHECK(layer.closed.size() == 2);
  CHECK(layer.open.empty());
  CHECK(area_of(layer) == Approx(130.0).epsilon(1e-9));
}

TEST_CASE("readers number the solids of a file", "[corpus][solids]") {
  if (!corpus_present()) {
    WARN("the model corpus is not there: skipped");
    return;
  }
  const auto solids_in = [](const std::string& file) {
    std::set<std::uint32_t> numbers;
    for (const engine::Surface& surface : engine::read_model(corpus_file(file)).model.surfaces)
      numbers.insert(surface.solid);
    return numbers;
  };
  CHECK(solids_in("parts/part_bracket_186.igs") == std::set<std::uint32_t>{1});
  CHECK(solids_in("parts/part_bracket_ap203.stp") == std::set<std::uint32_t>{1});
  CHECK(solids_in("parts/part_bracket_144.igs") == std::set<std::uint32_t>{0});
  CHECK(solids_in("real/as1-tu-203.stp").size() == 18);
  CHECK_FALSE(solids_in("real/as1-tu-203.stp").contains(0));
}

TEST_CASE("the layers of an assembly add up to the volume of its solids, bolts and all", "[corpus][solids]") {
  if (!corpus_present()) {
    WARN("the model corpus is not there: skipped");
    return;
  }
  const Model model = engine::read_model(corpus_file("real/as1-tu-203.stp")).model;
  // 18 solids that touch but do not overlap, from z = -4 to 80; the manifest has the sum of their volumes.
  constexpr double kVolume = 764518.03;
  constexpr double kThickness = 0.4;
  std::vector<engine::SlicePlane> planes;
  for (double z = -3.8; z < 80.0; z += kThickness) planes.push_back({z, z, z});
  engine::SliceOptions options;
  options.epsilon = kEpsilon;
  engine::Slicer slicer(model, planes, options);
  double volume = 0.0;
  while (const auto layer = slicer.next()) {
    CHECK(layer->report.open_gaps.empty());
    volume += kThickness * area_of(*layer);
  }
  CHECK(volume == Approx(kVolume).epsilon(1e-3));
}

}  // namespace
}  // namespace lamina::tests
