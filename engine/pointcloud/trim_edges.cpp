#include "engine/pointcloud/trim_edges.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lamina::engine {
namespace {

/// |z component| of the unit normal below which a surface counts as upright.
constexpr double kUpright = 0.02;
constexpr int kDeepestBisection = 16;
/// How far inside its trim curve a surface is looked at, in parts of the domain.
constexpr double kBeside = 1e-3;

/// Nodes along a lifted trim curve, chords within tolerance.
class EdgeTracer {
 public:
  EdgeTracer(const TrimRegion& region, std::uint32_t edge, double tolerance)
      : region_(region), edge_(edge), tolerance_(tolerance) {}

  std::vector<SectionNode> nodes() const {
    const std::vector<EdgeSample>& samples = region_.samples()[edge_];
    std::vector<SectionNode> result{{samples.front().position.head<2>(), Vector2::Zero(), Vector2::Zero()}};
    for (std::size_t k = 1; k < samples.size(); ++k) halve(samples[k - 1], samples[k], 0, result);
    set_tangents(result);
    return result;
  }

 private:
  void halve(const EdgeSample& from, const EdgeSample& to, int depth,
             std::vector<SectionNode>& result) const {
    const double t = 0.5 * (from.t + to.t);
    const Vector2 parameters = region_.on_edge(edge_, t);
    const EdgeSample middle{t, parameters, region_.on_surface(parameters)};
    const Vector2 chord = (to.position - from.position).head<2>();
    const Vector2 off = (middle.position - 0.5 * (from.position + to.position)).head<2>();
    const bool near = off.norm() <= 0.5 * tolerance_ || chord.norm() <= tolerance_;
    if (depth == kDeepestBisection || near) {
      result.push_back({to.position.head<2>(), Vector2::Zero(), Vector2::Zero()});
      return;
    }
    halve(from, middle, depth + 1, result);
    halve(middle, to, depth + 1, result);
  }

  /// From the neighbours, by the circle through three nodes; at the ends by reflection on the chord.
  static void set_tangents(std::vector<SectionNode>& nodes) {
    const std::size_t count = nodes.size();
    if (count < 2) return;
    for (std::size_t k = 1; k + 1 < count; ++k) {
      const Vector2 before = nodes[k].position - nodes[k - 1].position;
      const Vector2 after = nodes[k + 1].position - nodes[k].position;
      const double weight_before = 1.0 / std::max(before.squaredNorm(), 1e-300);
      const double weight_after = 1.0 / std::max(after.squaredNorm(), 1e-300);
      nodes[k].tangent = (weight_before * before + weight_after * after).normalized();
    }
    const auto reflected = [](const Vector2& tangent, const Vector2& chord) {
      const Vector2 along = chord.normalized();
      return Vector2(2.0 * tangent.dot(along) * along - tangent);
    };
    const Vector2 first = nodes[1].position - nodes[0].position;
    const Vector2 last = nodes[count - 1].position - nodes[count - 2].position;
    nodes.front().tangent = count == 2 ? Vector2(first.normalized()) : reflected(nodes[1].tangent, first);
    nodes.back().tangent =
        count == 2 ? Vector2(last.normalized()) : reflected(nodes[count - 2].tangent, last);
  }

  const TrimRegion& region_;
  std::uint32_t edge_;
  double tolerance_;
};

void append_arc(Section& section, const std::vector<SectionNode>& nodes, SectionArc arc,
                std::vector<SectionArc>& arcs) {
  arc.first = static_cast<std::uint32_t>(section.nodes.size());
  arc.count = static_cast<std::uint32_t>(nodes.size());
  section.nodes.insert(section.nodes.end(), nodes.begin(), nodes.end());
  arcs.push_back(arc);
}

/// A curve in the plane as the edge of what lies inside of it.
void add_edge(Section& section, const TrimRegion& region, std::uint32_t edge, double z,
              double chord_tolerance) {
  const std::vector<EdgeSample>& samples = region.samples()[edge];
  const std::size_t k = samples.size() / 2;
  const Vector2 along = samples[k].parameters - samples[k - 1].parameters;
  const NurbsSurface& surface = region.surface();
  const Vector2 size(surface.last_u() - surface.first_u(), surface.last_v() - surface.first_v());
  const Vector2 middle = 0.5 * (samples[k].parameters + samples[k - 1].parameters);
  const double length = along.norm();
  if (length == 0.0) return;
  Vector2 inwards = Vector2(-along.y(), along.x()) / length * kBeside * size.minCoeff();
  if (!region.chords().contains(middle + inwards)) inwards = -inwards;
  const double height = region.on_surface(middle + inwards).z() - z;
  const SurfaceDerivatives d = evaluate_derivatives(surface, middle.x(), middle.y());
  const Vector3 normal = d.du.cross(d.dv);
  const bool upright = std::abs(normal.z()) < kUpright * normal.norm();
  append_arc(section, EdgeTracer(region, edge, chord_tolerance).nodes(),
             {0, 0, region.number(), height > 0.0 ? ArcKind::kEdgeAbove : ArcKind::kEdgeBelow, upright},
             section.arcs);
}

/// A level surface in the plane: each loop a piece, a clockwise one a hole.
void add_level_face(Section& section, const TrimRegion& region, double chord_tolerance) {
  for (std::size_t loop = 0; loop < region.loops().size(); ++loop) {
    FlatPiece piece;
    piece.first_arc = static_cast<std::uint32_t>(section.flat_rims.size());
    piece.hole = region.turning(loop) < 0.0;
    Box2 box;
    for (std::uint32_t e = region.loops()[loop].first; e < region.loops()[loop].second; ++e) {
      const std::vector<SectionNode> nodes = EdgeTracer(region, e, chord_tolerance).nodes();
      for (const SectionNode& node : nodes) box.extend(node.position);
      append_arc(section, nodes, {0, 0, region.number(), ArcKind::kFlatRim, false}, section.flat_rims);
    }
    piece.arc_count = static_cast<std::uint32_t>(section.flat_rims.size()) - piece.first_arc;
    piece.size = box.sizes().maxCoeff();
    section.flats.push_back(piece);
  }
}

}  // namespace

void add_trim_edges(Section& section, const TrimRegion& region, double z, double chord_tolerance) {
  if (region.level()) {
    if (std::abs(region.z_min() - z) <= kModelTolerance) add_level_face(section, region, chord_tolerance);
    return;
  }
  for (std::uint32_t e = 0; e < region.edges().size(); ++e) {
    const std::vector<EdgeSample>& samples = region.samples()[e];
    if (region.is_level(e, z)) {
      add_edge(section, region, e, z, chord_tolerance);
    } else if (std::abs(samples.front().position.z() - z) <= kModelTolerance) {
      section.touches.push_back({samples.front().position.head<2>(), false});
    }
  }
  for (const Vector3& point : region.turning_points()) {
    if (std::abs(point.z() - z) <= kModelTolerance) section.touches.push_back({point.head<2>(), false});
  }
}

}  // namespace lamina::engine
