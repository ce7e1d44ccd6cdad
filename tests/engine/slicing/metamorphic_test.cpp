// The same solid given in another way has the same contours: turned about z, moved by parts of a cell,
// mirrored, scaled, its surfaces shuffled, with more knots, a higher degree, other parameters, with u and v
// exchanged. Chains of exact nodes and fitted curves alike.

#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "engine/import/read_model.h"
#include "engine/nurbs/bezier.h"
#include "engine/nurbs/knot_insertion.h"
#include "engine/slicer.h"
#include "tests/engine/slicing/sliced_layers.h"
#include "tests/support/analytic_models.h"
#include "tests/support/contour_measure.h"
#include "tests/support/corpus.h"
#include "tools/bench/contour_kinds.h"

namespace lamina::tests {
namespace {

using engine::LayerChains;
using engine::Loop;
using engine::Model;
using engine::Vector2;
using engine::Vector3;

constexpr unsigned kSeed = 21;
constexpr double kEpsilon = 0.02;
/// Each set of chords lies within a twentieth of epsilon of the section.
constexpr double kAllowed = 2.0 * 0.05 * kEpsilon + 1e-6;
constexpr double kFlattened = 0.01 * kEpsilon;
/// A fitted curve lies within another twentieth, and is flattened.
constexpr double kAllowedCurves = 2.0 * (0.05 + 0.05) * kEpsilon + 2.0 * kFlattened + 1e-6;

struct Subject {
  Model model;
  double z;
};

std::vector<Subject> subjects() {
  std::vector<Subject> result{
      {standing_torus({0, 0, 20}, 15.0, 5.0).model, 17.3},
      {united("spheres", {sphere({-4, 0, 8}, 8.0).model, sphere({4, 0, 8}, 8.0).model}), 9.1},
      {united("boxes", {box({0, 0, 0}, {10, 10, 10}).model, box({5, 5, 0}, {15, 15, 10}).model}), 4.4},
      {box_with_hole({0, 0, 0}, {20, 15, 10}, 4.0).model, 5.5}};
  if (corpus_present()) {
    result.push_back({engine::read_model(corpus_file("freeform/teapot28.igs")).model, 21.7});
    result.push_back({engine::read_model(corpus_file("seed/trefoil_swept.igs")).model, 7.7});
  } else {
    WARN("the model corpus is missing: freeform models left out");
  }
  return result;
}

/// What the plane gives, before and after curves are fitted.
struct Slice {
  LayerChains chains;
  engine::Layer layer;
};

Slice slice_at(const Model& model, double z) {
  engine::SliceOptions options;
  options.epsilon = kEpsilon;
  engine::Slicer slicer(model, {{z, z, z}}, options);
  return {chains_at(model, z, kEpsilon), *slicer.next()};
}

std::vector<Loop> mapped(std::vector<Loop> loops, const Eigen::Affine2d& map) {
  for (Loop& loop : loops) {
    for (Vector2& point : loop) point = map * point;
  }
  return loops;
}

void check_same(const Slice& slice, const Slice& expected, const Eigen::Affine2d& map) {
  REQUIRE(slice.chains.closed.size() == expected.chains.closed.size());
  CHECK(slice.chains.open.size() == expected.chains.open.size());
  CHECK(slice.chains.touch_curves.size() == expected.chains.touch_curves.size());
  CHECK(slice.chains.touch_points.size() == expected.chains.touch_points.size());
  const double scale = std::max(1.0, std::sqrt(std::abs(map.linear().determinant())));
  CHECK(greatest_difference(loops_of(slice.chains), mapped(loops_of(expected.chains), map)) <
        kAllowed * scale);
  CHECK(tools::kinds_of(slice.layer, kFlattened) == tools::kinds_of(expected.layer, kFlattened));
  CHECK(greatest_difference(closed_loops(slice.layer, kFlattened),
                            mapped(closed_loops(expected.layer, kFlattened), map)) < kAllowedCurves * scale);
}

void check_transformed(const Subject& subject, const Eigen::Affine3d& map3, const Eigen::Affine2d& map2) {
  const double z = (map3 * Vector3(0, 0, subject.z)).z();
  check_same(slice_at(engine::transformed(subject.model, map3), z), slice_at(subject.model, subject.z), map2);
}

/// The model as Bezier patches, each changed.
template <typename Change>
Model with_patches(const Model& model, Change change) {
  Model result;
  result.name = model.name;
  for (const engine::Surface& surface : model.surfaces) {
    for (engine::BezierPatch& patch : engine::bezier_patches(surface.nurbs)) {
      change(patch);
      const auto knots = [](int degree) {
        engine::Knots ends(static_cast<std::size_t>(degree) + 1, 0.0);
        ends.resize(2 * ends.size(), 1.0);
        return ends;
      };
      result.surfaces.emplace_back();
      result.surfaces.back().nurbs = {patch.degree_u, patch.degree_v, knots(patch.degree_u),
                                      knots(patch.degree_v), std::move(patch.net)};
    }
  }
  return result;
}

/// One degree more in u (The NURBS Book, equation 5.36, on homogeneous points).
void raise_degree_in_u(engine::BezierPatch& patch) {
  const int degree = patch.degree_u + 1;
  engine::ControlNet net{patch.net.count_u + 1, patch.net.count_v, {}};
  for (std::size_t i = 0; i < net.count_u; ++i) {
    const double part = static_cast<double>(i) / degree;
    for (std::size_t j = 0; j < net.count_v; ++j) {
      engine::Vector4 point = engine::Vector4::Zero();
      if (i > 0) point += part * patch.net.at(i - 1, j);
      if (i < patch.net.count_u) point += (1.0 - part) * patch.net.at(i, j);
      net.points.push_back(point);
    }
  }
  patch.degree_u = degree;
  patch.net = std::move(net);
}

/// A patch's parameters changed by rational linear functions: weights by powers of a factor each way.
void reparametrise(engine::BezierPatch& patch) {
  for (std::size_t i = 0; i < patch.net.count_u; ++i) {
    for (std::size_t j = 0; j < patch.net.count_v; ++j) {
      patch.net.at(i, j) *= std::pow(1.7, static_cast<double>(i)) * std::pow(0.6, static_cast<double>(j));
    }
  }
}

TEST_CASE("turned about z", "[slicing][metamorphic]") {
  for (const Subject& subject : subjects()) {
    for (const double angle : {0.1, 1.0, 2.5}) {
      Eigen::Affine2d turn2 = Eigen::Affine2d::Identity();
      turn2.rotate(angle);
      check_transformed(subject, Eigen::Affine3d(Eigen::AngleAxisd(angle, Vector3::UnitZ())), turn2);
    }
  }
}

TEST_CASE("moved by parts of a cell", "[slicing][metamorphic]") {
  for (const Subject& subject : subjects()) {
    for (const Vector2& step : {Vector2(0.3, 0.0), Vector2(0.5, 0.5), Vector2(0.001, 0.77)}) {
      const Vector2 by = kEpsilon * step;
      check_transformed(subject, Eigen::Affine3d(Eigen::Translation3d(by.x(), by.y(), 0.0)),
                        Eigen::Affine2d(Eigen::Translation2d(by)));
    }
  }
}

TEST_CASE("mirrored and scaled", "[slicing][metamorphic]") {
  for (const Subject& subject : subjects()) {
    Eigen::Affine3d mirror3 = Eigen::Affine3d::Identity();
    mirror3.scale(Vector3(-1, 1, 1));
    Eigen::Affine2d mirror2 = Eigen::Affine2d::Identity();
    mirror2.scale(Vector2(-1, 1));
    check_transformed(subject, mirror3, mirror2);

    const double scale = 1.37;
    Eigen::Affine3d larger3 = Eigen::Affine3d::Identity();
    larger3.scale(scale);
    Eigen::Affine2d larger2 = Eigen::Affine2d::Identity();
    larger2.scale(scale);
    check_transformed(subject, larger3, larger2);
  }
}

TEST_CASE("surfaces shuffled, u and v exchanged, more knots", "[slicing][metamorphic]") {
  INFO("seed " << kSeed);
  std::mt19937 random(kSeed);
  for (const Subject& subject : subjects()) {
    const Slice expected = slice_at(subject.model, subject.z);
    Model shuffled = subject.model;
    std::shuffle(shuffled.surfaces.begin(), shuffled.surfaces.end(), random);
    Model exchanged = subject.model;
    Model refined = subject.model;
    std::uniform_real_distribution<double> part(0.05, 0.95);
    for (engine::Surface& surface : exchanged.surfaces) {
      if (random() % 2 == 0) surface.nurbs = engine::transposed(surface.nurbs);
    }
    for (engine::Surface& surface : refined.surfaces) {
      const engine::NurbsSurface& s = surface.nurbs;
      surface.nurbs = engine::insert_knots(s, {s.first_u() + part(random) * (s.last_u() - s.first_u())},
                                           {s.first_v() + part(random) * (s.last_v() - s.first_v())});
    }
    for (const Model& variant : {shuffled, exchanged, refined}) {
      check_same(slice_at(variant, subject.z), expected, Eigen::Affine2d::Identity());
    }
  }
}

TEST_CASE("degree raised, reparametrised", "[slicing][metamorphic]") {
  for (const Subject& subject : subjects()) {
    const Slice expected = slice_at(subject.model, subject.z);
    const Model raised = with_patches(subject.model, [](engine::BezierPatch& patch) {
      raise_degree_in_u(patch);
      raise_degree_in_u(patch);
    });
    const Model reparametrised = with_patches(subject.model, reparametrise);
    Model stretched = subject.model;
    for (engine::Surface& surface : stretched.surfaces) {
      for (double& knot : surface.nurbs.knots_u) knot = 3.7 * knot - 11.0;
      for (double& knot : surface.nurbs.knots_v) knot = 0.01 * knot + 4.0;
    }
    for (const Model& variant : {raised, reparametrised, stretched}) {
      check_same(slice_at(variant, subject.z), expected, Eigen::Affine2d::Identity());
    }
  }
}

}  // namespace
}  // namespace lamina::tests
