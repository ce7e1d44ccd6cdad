#include "tools/bench/random_solids.h"

#include <cmath>
#include <numbers>

#include "engine/nurbs/knot_insertion.h"
#include "engine/nurbs/surface.h"
#include "tests/support/analytic_models.h"

namespace lamina::tools {
namespace {

using engine::Model;
using engine::Vector2;
using engine::Vector3;

constexpr int kKinds = 6;
constexpr int kSides = 8;

/// A surface that goes around periodically in u: cubic, kSides spans.
engine::NurbsSurface around(int degree_v, engine::Knots knots_v, std::size_t count_v) {
  engine::NurbsSurface surface;
  surface.degree_u = 3;
  surface.degree_v = degree_v;
  for (int k = 0; k < kSides + 7; ++k) surface.knots_u.push_back(k);
  surface.knots_v = std::move(knots_v);
  surface.net.count_u = kSides + 3;
  surface.net.count_v = count_v;
  return surface;
}

Vector2 direction(int side) {
  const double angle = 2.0 * std::numbers::pi * side / kSides;
  return {std::cos(angle), std::sin(angle)};
}

/// A box of plane faces whose normals (du, dv, normal being right-handed) all point outwards.
Model outward_box(const Vector3& size) {
  Model box = tests::box(Vector3::Zero(), size).model;
  for (engine::Surface& face : box.surfaces) {
    const engine::ControlNet& net = face.nurbs.net;
    const auto corner = [&](std::size_t i, std::size_t j) -> Vector3 { return net.at(i, j).head<3>(); };
    const Vector3 normal = (corner(1, 0) - corner(0, 0)).cross(corner(0, 1) - corner(0, 0));
    if (normal.dot(corner(0, 0) - 0.5 * size) < 0.0) face.nurbs = engine::transposed(face.nurbs);
  }
  return box;
}

}  // namespace

RandomSolid RandomSolids::next(int index) {
  RandomSolid result;
  const int count = 1 + index % 3;
  for (int k = 0; k < count; ++k) result.parts.push_back(posed(solid(index / 3 + k)));
  result.model = tests::united("random " + std::to_string(index), result.parts);
  return result;
}

double RandomSolids::number(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random_);
}

Model RandomSolids::solid(int kind) {
  switch (kind % kKinds) {
    case 0:
      return tests::sphere(Vector3::Zero(), number(1.0, 3.0)).model;
    case 1:
      return outward_box({number(1.0, 4.0), number(1.0, 4.0), number(1.0, 4.0)});
    case 2:
      return vase();
    case 3:
      return extrusion();
    case 4:
      return blob();
    default:
      return tests::standing_torus(Vector3::Zero(), number(2.0, 3.0), number(0.5, 1.0)).model;
  }
}

/// A cubic B-spline profile from axis to axis, turned once around.
Model RandomSolids::vase() {
  tests::Profile profile;
  profile.degree = 3;
  profile.knots = {0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4};
  for (int k = 0; k < 7; ++k) {
    const bool end = k == 0 || k == 6;
    profile.points.emplace_back(end ? 0.0 : number(0.8, 2.5), 0.6 * k, 1.0);
  }
  return tests::model_of("vase", {tests::revolved(profile, Vector3::Zero())});
}

/// A blob-shaped cubic outline, extruded, its ends closed by fans that shrink it to a point.
Model RandomSolids::extrusion() {
  const double height = number(1.0, 3.0);
  engine::NurbsSurface wall = around(1, {0, 0, 1, 2, 3, 3}, 4);
  std::vector<Vector2> outline;
  for (int k = 0; k < kSides; ++k) outline.emplace_back(number(1.0, 2.5) * direction(k));
  for (int k = 0; k < kSides + 3; ++k) {
    const Vector2& p = outline[static_cast<std::size_t>(k % kSides)];
    wall.net.points.emplace_back(0.0, 0.0, 0.0, 1.0);
    wall.net.points.emplace_back(p.x(), p.y(), 0.0, 1.0);
    wall.net.points.emplace_back(p.x(), p.y(), height, 1.0);
    wall.net.points.emplace_back(0.0, 0.0, height, 1.0);
  }
  return tests::model_of("extrusion", {engine::clamped(wall)});
}

/// A bicubic surface from pole to pole, dented at random.
Model RandomSolids::blob() {
  constexpr int kRings = 5;
  engine::NurbsSurface skin = around(3, {0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4}, kRings + 2);
  std::vector<std::vector<Vector3>> rings;
  for (int ring = 0; ring < kRings; ++ring) {
    rings.emplace_back();
    for (int k = 0; k < kSides; ++k) {
      const Vector2 place = number(0.9, 2.6) * direction(k);
      rings.back().emplace_back(place.x(), place.y(), ring + number(-0.4, 0.4));
    }
  }
  for (int k = 0; k < kSides + 3; ++k) {
    skin.net.points.emplace_back(0.0, 0.0, 0.0, 1.0);
    for (const std::vector<Vector3>& ring : rings) {
      skin.net.points.push_back(engine::homogeneous(ring[static_cast<std::size_t>(k % kSides)]));
    }
    skin.net.points.emplace_back(0.0, 0.0, kRings - 1.0, 1.0);
  }
  return tests::model_of("blob", {engine::clamped(skin)});
}

Model RandomSolids::posed(const Model& model) {
  const Vector3 axis(number(-1, 1), number(-1, 1), number(-1, 1));
  const Eigen::Affine3d pose = Eigen::Translation3d(number(-2, 2), number(-2, 2), number(-2, 2)) *
                               Eigen::AngleAxisd(number(0, 6.28), axis.normalized());
  return engine::transformed(model, pose);
}

}  // namespace lamina::tools
