#include "engine/pointcloud/facet_section.h"

#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "engine/model.h"

namespace lamina::engine {
namespace {

/// |z component| of the unit normal below which a triangle counts as upright.
constexpr double kUpright = 0.02;

struct Corner {
  Vector3 position;
  double height = 0.0;  ///< over the plane, mm; exactly 0 within the model tolerance
};

/// Where the plane crosses an edge, from whichever side the edge is seen.
Vector2 crossing(const Corner& one, const Corner& other) {
  const auto key = [](const Corner& corner) {
    return std::tuple(corner.position.x(), corner.position.y(), corner.position.z());
  };
  const bool in_order = key(one) < key(other);
  const Corner& a = in_order ? one : other;
  const Corner& b = in_order ? other : one;
  const double t = a.height / (a.height - b.height);
  return a.position.head<2>() + t * (b.position - a.position).head<2>();
}

/// Appends a straight arc that runs with `direction`; nothing where its ends coincide.
bool append_arc(Vector2 from, Vector2 to, const Vector2& direction, SectionArc arc, Section& section,
                std::vector<SectionArc>& arcs) {
  if (from == to) return false;
  if ((to - from).dot(direction) < 0.0) std::swap(from, to);
  const Vector2 tangent = (to - from).normalized();
  arc.first = static_cast<std::uint32_t>(section.nodes.size());
  arc.count = 2;
  section.nodes.push_back({from, tangent, Vector2::Zero()});
  section.nodes.push_back({to, tangent, Vector2::Zero()});
  arcs.push_back(arc);
  return true;
}

void append_flat(const std::array<Corner, 3>& corners, std::uint32_t surface, Section& section) {
  const auto first = static_cast<std::uint32_t>(section.flat_rims.size());
  Box2 box;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector2 from = corners[k].position.head<2>();
    const Vector2 to = corners[(k + 1) % 3].position.head<2>();
    box.extend(from);
    append_arc(from, to, to - from, {0, 0, surface, ArcKind::kFlatRim, false}, section, section.flat_rims);
  }
  section.flats.push_back({first, 3, box.sizes().maxCoeff(), false});
}

}  // namespace

void cut_facet(const FrontFacet& facet, std::uint32_t surface, double z, Section& section) {
  std::array<Corner, 3> corners;
  int in_plane = 0;
  int above = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k].position = facet.corners[k].cast<double>();
    double height = corners[k].position.z() - z;
    if (std::abs(height) <= kModelTolerance) height = 0.0;
    corners[k].height = height;
    in_plane += height == 0.0 ? 1 : 0;
    above += height > 0.0 ? 1 : 0;
  }
  if (in_plane == 0 && (above == 0 || above == 3)) return;
  const Vector3 normal =
      (corners[1].position - corners[0].position).cross(corners[2].position - corners[0].position);
  const double area = normal.norm();
  if (area == 0.0) return;
  ++section.cells;
  // e_z x normal: the section's direction, the outward normal on its right.
  const Vector2 direction(-normal.y(), normal.x());
  const bool upright = std::abs(normal.z()) < kUpright * area;

  if (in_plane == 3) {
    append_flat(corners, surface, section);
    return;
  }
  if (in_plane == 2) {
    const std::size_t apex = corners[0].height != 0.0 ? 0 : corners[1].height != 0.0 ? 1 : 2;
    const ArcKind kind = corners[apex].height > 0.0 ? ArcKind::kEdgeAbove : ArcKind::kEdgeBelow;
    append_arc(corners[(apex + 1) % 3].position.head<2>(), corners[(apex + 2) % 3].position.head<2>(),
               direction, {0, 0, surface, kind, upright}, section, section.arcs);
    return;
  }
  if (in_plane == 1 && above != 1) {
    for (const Corner& corner : corners) {
      if (corner.height == 0.0) section.touches.push_back({corner.position.head<2>(), above == 2});
    }
    return;
  }
  std::array<Vector2, 2> ends;
  std::size_t found = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Corner& a = corners[k];
    const Corner& b = corners[(k + 1) % 3];
    if (a.height == 0.0) {
      ends[found++] = a.position.head<2>();
    } else if (b.height != 0.0 && (a.height > 0.0) != (b.height > 0.0)) {
      ends[found++] = crossing(a, b);
    }
  }
  append_arc(ends[0], ends[1], direction, {0, 0, surface, ArcKind::kCrossing, false}, section, section.arcs);
}

}  // namespace lamina::engine
