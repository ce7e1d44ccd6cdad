#include "tests/support/analytic_models.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/nurbs/curve.h"

namespace lamina::tests {

using engine::Box3;
using engine::Knots;
using engine::Loop;
using engine::Model;
using engine::NurbsSurface;
using engine::Vector2;
using engine::Vector3;
using engine::Vector4;
using std::numbers::pi;

namespace {

double segment_distance(const Vector2& a, const Vector2& b, const Vector2& point) {
  const Vector2 side = b - a;
  const double squared = side.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((point - a).dot(side) / squared, 0.0, 1.0) : 0.0;
  return (point - a - t * side).norm();
}

/// A point of the circle of quadratic arcs with radius one: nine control points (The NURBS Book,
/// section 7.5).
struct CircleControlPoint {
  double x, y, weight;
};

const std::vector<CircleControlPoint>& unit_circle() {
  static const double s = std::sqrt(0.5);
  static const std::vector<CircleControlPoint> points{{1, 0, 1},  {1, 1, s},  {0, 1, 1},
                                                      {-1, 1, s}, {-1, 0, 1}, {-1, -1, s},
                                                      {0, -1, 1}, {1, -1, s}, {1, 0, 1}};
  return points;
}

Knots circle_knots() {
  return {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1};
}

/// The half or the whole of a circle in the half plane, from the lowest point on, counter-clockwise.
Profile arc_profile(const Vector2& centre, double radius, std::size_t quarters) {
  Profile profile;
  profile.degree = 2;
  profile.knots = {0, 0, 0};
  for (std::size_t k = 0; k <= 2 * quarters; ++k) {
    const CircleControlPoint& on_circle = unit_circle()[k % 8];
    // Turned back by a quarter: (x, y) becomes (y, -x).
    const double r = centre.x() + radius * on_circle.y;
    const double z = centre.y() - radius * on_circle.x;
    profile.points.emplace_back(on_circle.weight * r, on_circle.weight * z, on_circle.weight);
    const bool junction = k % 2 == 0 && k > 0 && k < 2 * quarters;
    if (junction)
      profile.knots.insert(profile.knots.end(), 2,
                           static_cast<double>(k) / static_cast<double>(2 * quarters));
  }
  profile.knots.insert(profile.knots.end(), 3, 1.0);
  return profile;
}

Box3 box_around(const Vector3& low, const Vector3& high) {
  return {low, high};
}

/// A quarter of a plane face between a circle and the side of the rectangle that faces it, at one height.
NurbsSurface rim_quarter(const Vector3& centre, double radius, double angle, const Vector2& from,
                         const Vector2& to) {
  const double s = std::sqrt(0.5);
  const auto on_circle = [&](double turned, double reach) {
    return Vector3(centre + reach * radius * Vector3(std::cos(turned), std::sin(turned), 0.0));
  };
  const Vector3 corner_a(from.x(), from.y(), centre.z());
  const Vector3 corner_b(to.x(), to.y(), centre.z());
  NurbsSurface surface;
  surface.degree_u = 2;
  surface.degree_v = 1;
  surface.knots_u = {0, 0, 0, 1, 1, 1};
  surface.knots_v = {0, 0, 1, 1};
  surface.net.count_u = 3;
  surface.net.count_v = 2;
  surface.net.points = {engine::homogeneous(on_circle(angle - pi / 4, 1.0)),
                        engine::homogeneous(corner_a),
                        engine::homogeneous(on_circle(angle, std::sqrt(2.0)), s),
                        engine::homogeneous(0.5 * (corner_a + corner_b), s),
                        engine::homogeneous(on_circle(angle + pi / 4, 1.0)),
                        engine::homogeneous(corner_b)};
  return surface;
}

std::vector<NurbsSurface> holed_rectangle(const Vector2& low, const Vector2& high, double radius, double z) {
  const Vector2 middle = 0.5 * (low + high);
  const Vector3 centre(middle.x(), middle.y(), z);
  const Vector2 low_right(high.x(), low.y());
  const Vector2 high_left(low.x(), high.y());
  return {rim_quarter(centre, radius, 0.0, low_right, high),
          rim_quarter(centre, radius, pi / 2, high, high_left),
          rim_quarter(centre, radius, pi, high_left, low),
          rim_quarter(centre, radius, 3 * pi / 2, low, low_right)};
}

std::vector<NurbsSurface> box_sides(const Vector3& low, const Vector3& high) {
  const auto at = [&](bool x, bool y, bool z) {
    return Vector3(x ? high.x() : low.x(), y ? high.y() : low.y(), z ? high.z() : low.z());
  };
  return {
      bilinear(at(false, false, false), at(true, false, false), at(false, false, true),
               at(true, false, true)),
      bilinear(at(false, true, false), at(true, true, false), at(false, true, true), at(true, true, true)),
      bilinear(at(false, false, false), at(false, true, false), at(false, false, true),
               at(false, true, true)),
      bilinear(at(true, false, false), at(true, true, false), at(true, false, true), at(true, true, true))};
}

NurbsSurface level_rectangle(const Vector2& low, const Vector2& high, double z) {
  return bilinear({low.x(), low.y(), z}, {high.x(), low.y(), z}, {low.x(), high.y(), z},
                  {high.x(), high.y(), z});
}

/// The spiric curve of a torus around the y axis at height z above its centre, by the angle around the tube.
std::vector<Loop> spiric_loops(const Vector2& centre, double z, double major_radius, double minor_radius) {
  constexpr int kSteps = 2000;
  const auto point = [&](double angle, double side) {
    const double reach = major_radius + minor_radius * std::cos(angle);
    return Vector2(centre + Vector2(side * std::sqrt(std::max(0.0, reach * reach - z * z)),
                                    minor_radius * std::sin(angle)));
  };
  if (std::abs(z) < major_radius - minor_radius) {
    std::vector<Loop> loops(2);
    for (int k = 0; k < kSteps; ++k) {
      loops[0].push_back(point(2 * pi * k / kSteps, 1.0));
      loops[1].push_back(point(2 * pi * k / kSteps, -1.0));
    }
    return loops;
  }
  // Only where the tube reaches out to the plane: |angle| <= widest; even steps of sin make the ends dense.
  const double widest = std::acos(std::clamp((std::abs(z) - major_radius) / minor_radius, -1.0, 1.0));
  Loop loop;
  for (const double side : {1.0, -1.0}) {
    for (int k = 0; k < kSteps; ++k) {
      loop.push_back(point(side * widest * std::sin(pi * (static_cast<double>(k) / kSteps - 0.5)), side));
    }
  }
  return {loop};
}

/// The same section with what is known of the surface's normal.
Section leaning(Section section, double normal_z) {
  section.normal_z = normal_z;
  return section;
}

}  // namespace

Section circle_section(const Vector2& centre, double radius) {
  Section section;
  section.area = pi * radius * radius;
  section.perimeter = 2 * pi * radius;
  section.curves = 1;
  section.turning = 2 * pi;
  section.distance = [=](const Vector2& point) { return std::abs((point - centre).norm() - radius); };
  section.points = [=](double step) {
    std::vector<Vector2> points;
    const auto count = static_cast<int>(std::ceil(2 * pi * radius / step)) + 3;
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * pi * k / count;
      points.emplace_back(centre + radius * Vector2(std::cos(angle), std::sin(angle)));
    }
    return points;
  };
  return section;
}

Section polyline_section(const std::vector<Loop>& loops) {
  Section section;
  section.curves = loops.size();
  for (const Loop& loop : loops) {
    section.area += std::abs(engine::signed_area(loop));
    section.perimeter += engine::perimeter(loop);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vector2 in = loop[(i + 1) % loop.size()] - loop[i];
      const Vector2 out = loop[(i + 2) % loop.size()] - loop[(i + 1) % loop.size()];
      section.turning += std::abs(std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out)));
    }
  }
  section.distance = [=](const Vector2& point) {
    double least = std::numeric_limits<double>::infinity();
    for (const Loop& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        least = std::min(least, segment_distance(loop[i], loop[(i + 1) % loop.size()], point));
      }
    }
    return least;
  };
  section.points = [=](double step) {
    std::vector<Vector2> points;
    for (const Loop& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vector2 side = loop[(i + 1) % loop.size()] - loop[i];
        const double count = std::max(1.0, std::ceil(side.norm() / step));
        for (double k = 0.0; k < count; ++k) points.emplace_back(loop[i] + k / count * side);
      }
    }
    return points;
  };
  return section;
}

Section rectangle_section(const Vector2& low, const Vector2& high) {
  return polyline_section({{low, {high.x(), low.y()}, high, {low.x(), high.y()}}});
}

Section beside(const Section& a, const Section& b) {
  Section both;
  both.area = a.area + b.area;
  both.perimeter = a.perimeter + b.perimeter;
  both.curves = a.curves + b.curves;
  both.turning = a.turning + b.turning;
  both.normal_z = std::max(a.normal_z, b.normal_z);
  both.distance = [=](const Vector2& point) { return std::min(a.distance(point), b.distance(point)); };
  both.points = [=](double step) {
    std::vector<Vector2> points = a.points(step);
    const std::vector<Vector2> others = b.points(step);
    points.insert(points.end(), others.begin(), others.end());
    return points;
  };
  return both;
}

Section with_hole(const Section& outer, const Section& hole) {
  Section section = beside(outer, hole);
  section.area = outer.area - hole.area;
  return section;
}

NurbsSurface revolved(const Profile& profile, const Vector3& axis) {
  NurbsSurface surface;
  surface.degree_u = 2;
  surface.degree_v = profile.degree;
  surface.knots_u = circle_knots();
  surface.knots_v = profile.knots;
  surface.net.count_u = unit_circle().size();
  surface.net.count_v = profile.points.size();
  for (const CircleControlPoint& around : unit_circle()) {
    for (const Vector3& along : profile.points) {
      const double weight = around.weight * along.z();
      const double radius = along.x() / along.z();
      const Vector3 offset(radius * around.x, radius * around.y, along.y() / along.z());
      surface.net.points.push_back(engine::homogeneous(axis + offset, weight));
    }
  }
  return surface;
}

Profile segment_profile(const Vector2& from, const Vector2& to) {
  return {1, {0, 0, 1, 1}, {{from.x(), from.y(), 1.0}, {to.x(), to.y(), 1.0}}};
}

NurbsSurface bilinear(const Vector3& p00, const Vector3& p10, const Vector3& p01, const Vector3& p11) {
  NurbsSurface surface;
  surface.knots_u = {0, 0, 1, 1};
  surface.knots_v = {0, 0, 1, 1};
  surface.net.count_u = 2;
  surface.net.count_v = 2;
  surface.net.points = {engine::homogeneous(p00), engine::homogeneous(p01), engine::homogeneous(p10),
                        engine::homogeneous(p11)};
  return surface;
}

NurbsSurface transformed(const NurbsSurface& surface, const Eigen::Affine3d& transform) {
  NurbsSurface result = surface;
  for (Vector4& point : result.net.points) {
    point = engine::homogeneous(transform * engine::cartesian(point), point.w());
  }
  return result;
}

NurbsSurface cylinder_patch(const Vector3& base, double radius, double from, double to, double height) {
  const double weight = std::cos(0.5 * (to - from));
  const auto at = [&](double angle, double reach, double z) {
    return Vector3(base + Vector3(reach * std::cos(angle), reach * std::sin(angle), z));
  };
  NurbsSurface surface;
  surface.degree_u = 2;
  surface.degree_v = 1;
  surface.knots_u = {0, 0, 0, 1, 1, 1};
  surface.knots_v = {0, 0, 1, 1};
  surface.net.count_u = 3;
  surface.net.count_v = 2;
  const double middle = 0.5 * (from + to);
  for (const auto& [angle, reach, w] :
       {std::tuple{from, radius, 1.0}, std::tuple{middle, radius / weight, weight},
        std::tuple{to, radius, 1.0}}) {
    surface.net.points.push_back(engine::homogeneous(at(angle, reach, 0.0), w));
    surface.net.points.push_back(engine::homogeneous(at(angle, reach, height), w));
  }
  return surface;
}

Model model_of(std::string name, const std::vector<NurbsSurface>& surfaces) {
  Model model;
  model.name = std::move(name);
  for (const NurbsSurface& surface : surfaces) {
    model.surfaces.push_back({});
    model.surfaces.back().nurbs = surface;
  }
  return model;
}

Model united(std::string name, const std::vector<Model>& models) {
  Model all;
  all.name = std::move(name);
  for (const Model& model : models) {
    all.surfaces.insert(all.surfaces.end(), model.surfaces.begin(), model.surfaces.end());
  }
  return all;
}

AnalyticModel sphere(const Vector3& centre, double radius) {
  AnalyticModel sphere;
  sphere.model = model_of("sphere", {revolved(arc_profile(Vector2::Zero(), radius, 2), centre)});
  sphere.box = box_around(centre - Vector3::Constant(radius), centre + Vector3::Constant(radius));
  sphere.volume = 4.0 / 3.0 * pi * radius * radius * radius;
  sphere.section = [=](double z) {
    const double height = z - centre.z();
    return leaning(circle_section(centre.head<2>(), std::sqrt(radius * radius - height * height)),
                   std::abs(height) / radius);
  };
  return sphere;
}

AnalyticModel upright_cylinder(const Vector3& base, double radius, double height) {
  AnalyticModel cylinder;
  cylinder.model =
      model_of("upright cylinder", {revolved(segment_profile({radius, 0}, {radius, height}), base),
                                    revolved(segment_profile({0, 0}, {radius, 0}), base),
                                    revolved(segment_profile({0, height}, {radius, height}), base)});
  cylinder.box = box_around(base - Vector3(radius, radius, 0), base + Vector3(radius, radius, height));
  cylinder.volume = pi * radius * radius * height;
  cylinder.section = [=](double) { return circle_section(base.head<2>(), radius); };
  return cylinder;
}

AnalyticModel lying_cylinder(const Vector3& start, double radius, double length) {
  AnalyticModel cylinder = upright_cylinder(Vector3::Zero(), radius, length);
  Eigen::Affine3d lay = Eigen::Affine3d::Identity();
  lay.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // z to x, x to y, y to z: exact
  lay.translation() = start;
  for (engine::Surface& surface : cylinder.model.surfaces) surface.nurbs = transformed(surface.nurbs, lay);
  cylinder.model.name = "lying cylinder";
  cylinder.box = box_around(start - Vector3(0, radius, radius), start + Vector3(length, radius, radius));
  cylinder.section = [=](double z) {
    const double height = z - start.z();
    const double half = std::sqrt(radius * radius - height * height);
    return leaning(
        rectangle_section(start.head<2>() - Vector2(0, half), start.head<2>() + Vector2(length, half)),
        std::abs(height) / radius);
  };
  return cylinder;
}

AnalyticModel cone(const Vector3& base, double radius, double height) {
  AnalyticModel cone;
  cone.model = model_of("cone", {revolved(segment_profile({radius, 0}, {0, height}), base),
                                 revolved(segment_profile({0, 0}, {radius, 0}), base)});
  cone.box = box_around(base - Vector3(radius, radius, 0), base + Vector3(radius, radius, height));
  cone.volume = pi * radius * radius * height / 3.0;
  cone.section = [=](double z) {
    return leaning(circle_section(base.head<2>(), radius * (1.0 - (z - base.z()) / height)),
                   radius / std::hypot(radius, height));
  };
  return cone;
}

AnalyticModel flat_torus(const Vector3& centre, double major_radius, double minor_radius) {
  AnalyticModel torus;
  torus.model = model_of("flat torus", {revolved(arc_profile({major_radius, 0}, minor_radius, 4), centre)});
  const Vector3 reach(major_radius + minor_radius, major_radius + minor_radius, minor_radius);
  torus.box = box_around(centre - reach, centre + reach);
  torus.volume = 2 * pi * pi * major_radius * minor_radius * minor_radius;
  torus.section = [=](double z) {
    const double height = z - centre.z();
    const double half = std::sqrt(minor_radius * minor_radius - height * height);
    return leaning(with_hole(circle_section(centre.head<2>(), major_radius + half),
                             circle_section(centre.head<2>(), major_radius - half)),
                   std::abs(height) / minor_radius);
  };
  return torus;
}

AnalyticModel standing_torus(const Vector3& centre, double major_radius, double minor_radius) {
  AnalyticModel torus = flat_torus(Vector3::Zero(), major_radius, minor_radius);
  Eigen::Affine3d raise = Eigen::Affine3d::Identity();
  raise.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // y to z, z to -y: exact
  raise.translation() = centre;
  for (engine::Surface& surface : torus.model.surfaces) surface.nurbs = transformed(surface.nurbs, raise);
  torus.model.name = "standing torus";
  const Vector3 reach(major_radius + minor_radius, minor_radius, major_radius + minor_radius);
  torus.box = box_around(centre - reach, centre + reach);
  torus.section = [=](double z) {
    // The normal leans most where the curve is nearest to the axis or, above the hole, on the tube's outside.
    const double height = std::abs(z - centre.z());
    const double inside = major_radius - minor_radius;
    return leaning(
        polyline_section(spiric_loops(centre.head<2>(), z - centre.z(), major_radius, minor_radius)),
        height < inside ? height / inside : 1.0);
  };
  return torus;
}

AnalyticModel box(const Vector3& low, const Vector3& high) {
  AnalyticModel box;
  std::vector<NurbsSurface> faces = box_sides(low, high);
  faces.push_back(level_rectangle(low.head<2>(), high.head<2>(), low.z()));
  faces.push_back(level_rectangle(low.head<2>(), high.head<2>(), high.z()));
  box.model = model_of("box", faces);
  box.box = box_around(low, high);
  box.volume = (high - low).prod();
  box.section = [=](double) { return rectangle_section(low.head<2>(), high.head<2>()); };
  return box;
}

AnalyticModel box_with_hole(const Vector3& low, const Vector3& high, double hole_radius) {
  AnalyticModel box;
  const double height = high.z() - low.z();
  const Vector2 middle = 0.5 * (low + high).head<2>();
  const Vector3 hole_base(middle.x(), middle.y(), low.z());
  std::vector<NurbsSurface> faces = box_sides(low, high);
  faces.push_back(revolved(segment_profile({hole_radius, 0}, {hole_radius, height}), hole_base));
  for (const double z : {low.z(), high.z()}) {
    for (const NurbsSurface& quarter : holed_rectangle(low.head<2>(), high.head<2>(), hole_radius, z)) {
      faces.push_back(quarter);
    }
  }
  box.model = model_of("box with hole", faces);
  box.box = box_around(low, high);
  box.volume = (high - low).prod() - pi * hole_radius * hole_radius * height;
  box.section = [=](double) {
    return with_hole(rectangle_section(low.head<2>(), high.head<2>()), circle_section(middle, hole_radius));
  };
  return box;
}

AnalyticModel tube(const Vector3& base, double inner_radius, double outer_radius, double height) {
  AnalyticModel tube;
  tube.model =
      model_of("tube", {revolved(segment_profile({outer_radius, 0}, {outer_radius, height}), base),
                        revolved(segment_profile({inner_radius, 0}, {inner_radius, height}), base),
                        revolved(segment_profile({inner_radius, 0}, {outer_radius, 0}), base),
                        revolved(segment_profile({inner_radius, height}, {outer_radius, height}), base)});
  tube.box = box_around(base - Vector3(outer_radius, outer_radius, 0),
                        base + Vector3(outer_radius, outer_radius, height));
  tube.volume = pi * (outer_radius * outer_radius - inner_radius * inner_radius) * height;
  tube.section = [=](double) {
    return with_hole(circle_section(base.head<2>(), outer_radius),
                     circle_section(base.head<2>(), inner_radius));
  };
  return tube;
}

}  // namespace lamina::tests
