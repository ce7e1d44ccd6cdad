// The same solid given in another way has the same contours: turned about z, moved by parts of a cell,
// mirrored, scaled, its surfaces shuffled, with more knots, with u and v exchanged.

#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "engine/import/read_model.h"
#include "engine/nurbs/knot_insertion.h"
#include "tests/engine/slicing/sliced_layers.h"
#include "tests/support/analytic_models.h"
#include "tests/support/contour_measure.h"
#include "tests/support/corpus.h"

namespace lamina::tests {
namespace {

using engine::LayerChains;
using engine::Loop;
using engine::Model;
using engine::Vector2;
using engine::Vector3;

constexpr unsigned kSeed = 21;
constexpr double kEpsilon = 0.02;
/// Both chords and curve: each set of chords lies within a twentieth of epsilon of the section.
constexpr double kAllowed = 2.0 * 0.05 * kEpsilon + 1e-6;

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

void check_same(const LayerChains& chains, const LayerChains& expected, const Eigen::Affine2d& map) {
  REQUIRE(chains.closed.size() == expected.closed.size());
  CHECK(chains.open.size() == expected.open.size());
  CHECK(chains.touch_curves.size() == expected.touch_curves.size());
  CHECK(chains.touch_points.size() == expected.touch_points.size());
  std::vector<Loop> moved = loops_of(expected);
  for (Loop& loop : moved) {
    for (Vector2& point : loop) point = map * point;
  }
  const double scale = std::sqrt(std::abs(map.linear().determinant()));
  CHECK(greatest_difference(loops_of(chains), moved) < kAllowed * std::max(1.0, scale));
}

void check_transformed(const Subject& subject, const Eigen::Affine3d& map3, const Eigen::Affine2d& map2) {
  const LayerChains expected = chains_at(subject.model, subject.z, kEpsilon);
  const double z = (map3 * Vector3(0, 0, subject.z)).z();
  check_same(chains_at(engine::transformed(subject.model, map3), z, kEpsilon), expected, map2);
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
    const LayerChains expected = chains_at(subject.model, subject.z, kEpsilon);
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
      check_same(chains_at(variant, subject.z, kEpsilon), expected, Eigen::Affine2d::Identity());
    }
  }
}

}  // namespace
}  // namespace lamina::tests
