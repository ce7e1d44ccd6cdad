#include "engine/import/trim/surface_topology.h"

#include <algorithm>
#include <cassert>

#include "engine/nurbs/restrict.h"

namespace lamina::engine {
namespace {

/// Points along one side, evenly spaced in its parameter.
std::array<Vector3, 9> points_along(const NurbsSurface& surface, Side side) {
  std::array<Vector3, 9> points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(points.size() - 1);
    double u = surface.first_u() + part * (surface.last_u() - surface.first_u());
    double v = surface.first_v() + part * (surface.last_v() - surface.first_v());
    if (side == Side::kFirstU) u = surface.first_u();
    if (side == Side::kLastU) u = surface.last_u();
    if (side == Side::kFirstV) v = surface.first_v();
    if (side == Side::kLastV) v = surface.last_v();
    points[i] = evaluate(surface, u, v);
  }
  return points;
}

bool meet(const std::array<Vector3, 9>& a, const std::array<Vector3, 9>& b, double tolerance) {
  return std::equal(a.begin(), a.end(), b.begin(),
                    [tolerance](const Vector3& p, const Vector3& q) { return (p - q).norm() <= tolerance; });
}

}  // namespace

std::optional<Side> SurfaceTopology::pole_at(const Vector3& point, double tolerance) const {
  for (const Side side : {Side::kFirstU, Side::kLastU, Side::kFirstV, Side::kLastV}) {
    const auto& pole = poles[static_cast<std::size_t>(side)];
    if (pole && (point - *pole).norm() <= tolerance) return side;
  }
  return std::nullopt;
}

SurfaceTopology surface_topology(const NurbsSurface& surface, double tolerance) {
  SurfaceTopology topology;
  topology.size = control_box(surface.net).diagonal().norm();
  std::array<std::array<Vector3, 9>, 4> sides;
  for (const Side side : {Side::kFirstU, Side::kLastU, Side::kFirstV, Side::kLastV}) {
    const auto at = static_cast<std::size_t>(side);
    sides[at] = points_along(surface, side);
    Vector3 mean = Vector3::Zero();
    for (const Vector3& point : sides[at]) mean += point / static_cast<double>(sides[at].size());
    std::array<Vector3, 9> same;
    same.fill(mean);
    if (meet(sides[at], same, tolerance)) topology.poles[at] = mean;
  }
  const auto closes = [&](Side first, Side last) {
    const auto a = static_cast<std::size_t>(first);
    const auto b = static_cast<std::size_t>(last);
    return !topology.poles[a] && !topology.poles[b] && meet(sides[a], sides[b], tolerance);
  };
  if (closes(Side::kFirstU, Side::kLastU)) topology.period_u = surface.last_u() - surface.first_u();
  if (closes(Side::kFirstV, Side::kLastV)) topology.period_v = surface.last_v() - surface.first_v();
  return topology;
}

NurbsSurface with_seam_at_u(const NurbsSurface& surface, double first_u) {
  const double period = surface.last_u() - surface.first_u();
  assert(surface.first_u() < first_u && first_u < surface.last_u());
  NurbsSurface result = restricted(surface, first_u, surface.last_u(), surface.first_v(), surface.last_v());
  const NurbsSurface rest =
      restricted(surface, surface.first_u(), first_u, surface.first_v(), surface.last_v());
  // Both are clamped: the knots of the joint keep the multiplicity of the degree.
  result.knots_u.pop_back();
  for (auto knot = rest.knots_u.begin() + rest.degree_u + 1; knot != rest.knots_u.end(); ++knot) {
    result.knots_u.push_back(*knot + period);
  }
  const std::size_t joint = result.net.count_u - 1;
  // All homogeneous points times one factor are the same surface.
  const double factor = result.net.at(joint, 0).w() / rest.net.at(0, 0).w();
  for (std::size_t i = 1; i < rest.net.count_u; ++i) {
    for (std::size_t j = 0; j < rest.net.count_v; ++j) {
      result.net.points.emplace_back(factor * rest.net.at(i, j));
    }
  }
  result.net.count_u += rest.net.count_u - 1;
  return result;
}

}  // namespace lamina::engine
