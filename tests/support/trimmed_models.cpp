#include "tests/support/trimmed_models.h"

#include <cmath>
#include <utility>

#include "tests/support/analytic_models.h"

namespace lamina::tests {

using engine::NurbsCurve;
using engine::Surface;
using engine::TrimLoop;
using engine::Vector2;
using engine::Vector3;
using engine::Vector4;

TrimLoop polygon_loop(const std::vector<Vector2>& corners) {
  TrimLoop loop;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2& a = corners[k];
    const Vector2& b = corners[(k + 1) % corners.size()];
    loop.curves.push_back({1, {0, 0, 1, 1}, {{a.x(), a.y(), 0, 1}, {b.x(), b.y(), 0, 1}}});
  }
  return loop;
}

TrimLoop circle_loop(const Vector2& centre, double radius, bool clockwise) {
  NurbsCurve circle{2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, {}};
  const int steps[9][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
  for (int k = 0; k < 9; ++k) {
    const double w = k % 2 == 0 ? 1.0 : std::sqrt(0.5);
    const int turn = clockwise ? -1 : 1;
    circle.control_points.emplace_back(w * (centre.x() + radius * steps[k][0]),
                                       w * (centre.y() + radius * turn * steps[k][1]), 0.0, w);
  }
  return {{circle}};
}

Surface trimmed_plane(const Vector3& origin, const Vector3& along_u, const Vector3& along_v, double margin,
                      std::vector<TrimLoop> loops) {
  const double low = -margin;
  const double high = 1.0 + margin;
  Surface surface;
  surface.nurbs.knots_u = surface.nurbs.knots_v = {low, low, high, high};
  surface.nurbs.net.count_u = surface.nurbs.net.count_v = 2;
  for (const double u : {low, high}) {
    for (const double v : {low, high})
      surface.nurbs.net.points.push_back(engine::homogeneous(origin + u * along_u + v * along_v));
  }
  surface.trim = std::move(loops);
  return surface;
}

engine::Model trimmed_box_with_hole(const Vector3& low, const Vector3& high, double hole_radius) {
  const Vector3 size = high - low;
  const Vector3 x(size.x(), 0, 0);
  const Vector3 y(0, size.y(), 0);
  const Vector3 z(0, 0, size.z());
  const TrimLoop square = polygon_loop({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  engine::Model model;
  model.name = "trimmed box with hole";
  for (const auto& [origin, u, v] :
       {std::tuple(low, x, z), std::tuple(Vector3(low + x), y, z),
        std::tuple(Vector3(low + x + y), Vector3(-x), z), std::tuple(Vector3(low + y), Vector3(-y), z)})
    model.surfaces.push_back(trimmed_plane(origin, u, v, 0.3, {square}));
  // Top and bottom in mm, so that the circle is one.
  const Vector3 ex = Vector3::UnitX();
  const Vector3 ey = Vector3::UnitY();
  for (const double height : {low.z(), high.z()}) {
    const Vector3 origin(low.x(), low.y(), height);
    model.surfaces.push_back(
        trimmed_plane(origin, ex, ey, size.norm(),
                      {polygon_loop({{0, 0}, {size.x(), 0}, {size.x(), size.y()}, {0, size.y()}}),
                       circle_loop(0.5 * size.head<2>(), hole_radius, true)}));
  }
  // The wall of the hole reaches beyond both faces, v from 0 to 1 over twice the height.
  const Vector3 axis(low.x() + 0.5 * size.x(), low.y() + 0.5 * size.y(), 0.0);
  Surface wall;
  wall.nurbs = revolved(
      segment_profile({hole_radius, high.z() + 0.5 * size.z()}, {hole_radius, low.z() - 0.5 * size.z()}),
      axis);
  const double u0 = wall.nurbs.first_u();
  const double u1 = wall.nurbs.last_u();
  const double v0 = wall.nurbs.first_v();
  const double span = wall.nurbs.last_v() - v0;
  wall.trim = {polygon_loop(
      {{u0, v0 + 0.25 * span}, {u1, v0 + 0.25 * span}, {u1, v0 + 0.75 * span}, {u0, v0 + 0.75 * span}})};
  model.surfaces.push_back(wall);
  return model;
}

}  // namespace lamina::tests
