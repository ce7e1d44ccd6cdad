#include "engine/contour/in_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/contour/link_arcs.h"
#include "engine/contour/node_chain.h"
#include "engine/contour/unite_chains.h"
#include "engine/geometry/polygon.h"
#include "engine/geometry/segment_distance.h"

namespace lamina::engine {
namespace {

/// An edge in the plane, with what is asked about it.
struct Edge {
  SectionArc arc;
  Vector2 middle;  ///< half way along
  Box2 box;
};

Edge make_edge(const Section& section, const SectionArc& arc) {
  Edge edge{arc, Vector2::Zero(), Box2()};
  double length = 0.0;
  const auto at = [&](std::uint32_t k) { return section.nodes[arc.first + k].position; };
  for (std::uint32_t k = 0; k < arc.count; ++k) {
    edge.box.extend(at(k));
    if (k > 0) length += (at(k) - at(k - 1)).norm();
  }
  double left = 0.5 * length;
  for (std::uint32_t k = 1; k < arc.count; ++k) {
    const double step = (at(k) - at(k - 1)).norm();
    if (step >= left && step > 0.0) {
      edge.middle = at(k - 1) + left / step * (at(k) - at(k - 1));
      break;
    }
    left -= step;
  }
  return edge;
}

bool lies_on(const Section& section, const Edge& edge, const Vector2& place, double tolerance) {
  if (edge.box.squaredExteriorDistance(place) > tolerance * tolerance) return false;
  for (std::uint32_t k = 1; k < edge.arc.count; ++k) {
    const std::uint32_t node = edge.arc.first + k;
    if (squared_distance(place, section.nodes[node - 1].position, section.nodes[node].position) <=
        tolerance * tolerance) {
      return true;
    }
  }
  return false;
}

std::size_t count_on(const Section& section, const std::vector<Edge>& edges, const Vector2& place,
                     double tolerance) {
  return static_cast<std::size_t>(std::count_if(edges.begin(), edges.end(), [&](const Edge& edge) {
    return lies_on(section, edge, place, tolerance);
  }));
}

/// Whether an edge that came earlier runs through the middle of edge k.
bool repeats_earlier(const Section& section, const std::vector<Edge>& edges, std::size_t k,
                     double tolerance) {
  for (std::size_t j = 0; j < k; ++j) {
    if (lies_on(section, edges[j], edges[k].middle, tolerance)) return true;
  }
  return false;
}

/// The patches in the plane, as closed chains.
std::vector<NodeChain> flat_loops(const Section& section) {
  std::vector<NodeChain> loops;
  for (const FlatPiece& flat : section.flats) {
    NodeChain loop;
    loop.closed = true;
    for (std::uint32_t side = 0; side < flat.arc_count; ++side) {
      const SectionArc& arc = section.flat_rims[flat.first_arc + side];
      for (std::uint32_t k = 0; k + 1 < arc.count; ++k) {
        const SectionNode& node = section.nodes[arc.first + k];
        const bool corner = k == 0;
        loop.nodes.push_back({node.position, node.tangent, node.tangent, corner, true});
        if (corner && loop.nodes.size() > 1) {
          loop.nodes.back().tangent_in = section.back(section.flat_rims[flat.first_arc + side - 1]).tangent;
        }
      }
    }
    loop.nodes.front().tangent_in =
        section.back(section.flat_rims[flat.first_arc + flat.arc_count - 1]).tangent;
    for (ContourNode& node : loop.nodes) node.corner = is_corner(node.tangent_in, node.tangent_out);
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<FaceOutline> face_outlines(const Section& section) {
  std::vector<FaceOutline> faces;
  if (section.flats.empty()) return faces;
  std::vector<NodeChain> loops_in = flat_loops(section);
  for (std::size_t k = 0; k < loops_in.size(); ++k) {
    // The face on the left: around a hole clockwise.
    if ((signed_area(loop_of(loops_in[k])) > 0.0) == section.flats[k].hole) reverse(loops_in[k]);
  }
  std::vector<NodeChain> outlines = covered_outlines(loops_in, 1);
  std::vector<NodeChain> holes;
  std::vector<Loop> loops;
  for (NodeChain& outline : outlines) {
    Loop loop = loop_of(outline);
    if (signed_area(loop) > 0.0) {
      faces.push_back({std::move(outline), {}});
      loops.push_back(std::move(loop));
    } else {
      holes.push_back(std::move(outline));
    }
  }
  for (NodeChain& hole : holes) {
    std::size_t owner = faces.size();
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const double area = signed_area(loops[f]);
      // A hole may touch the outer rim in a node: the middle of a side does not.
      const Vector2 place = 0.5 * (hole.nodes[0].position + hole.nodes[1].position);
      if (area < smallest && contains(loops[f], place)) {
        smallest = area;
        owner = f;
      }
    }
    if (owner < faces.size()) faces[owner].inner.push_back(std::move(hole));
  }
  return faces;
}

double face_width(const FaceOutline& face) {
  const Loop outer = loop_of(face.outer);
  double filled = signed_area(outer);
  double rim = perimeter(outer);
  for (const NodeChain& hole : face.inner) {
    const Loop loop = loop_of(hole);
    filled += signed_area(loop);
    rim += perimeter(loop);
  }
  return 2.0 * filled / rim;
}

/// The curve along which the plane grazes the model, from the narrow face found there.
void add_grazed(const FaceOutline& face, double epsilon, InPlane& result) {
  const Loop loop = loop_of(face.outer);
  Box2 box;
  for (const Vector2& point : loop) box.extend(point);
  if (box.sizes().maxCoeff() <= epsilon) {
    result.touch_points.emplace_back(box.center());
    return;
  }
  if (!face.inner.empty()) {
    result.touch_curves.push_back(face.outer);
    return;
  }
  // A strip: one of its long sides, between the two nodes farthest apart.
  const auto farthest = [&](const Vector2& from) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < loop.size(); ++k) {
      if ((loop[k] - from).squaredNorm() > (loop[best] - from).squaredNorm()) best = k;
    }
    return best;
  };
  const std::size_t first = farthest(loop.front());
  const std::size_t last = farthest(loop[first]);
  NodeChain side;
  for (std::size_t k = first;; k = (k + 1) % loop.size()) {
    side.nodes.push_back(face.outer.nodes[k]);
    if (k == last) break;
  }
  result.touch_curves.push_back(std::move(side));
}

bool on_chain(const NodeChain& chain, const Vector2& place, double tolerance) {
  return distance_to_chain(place, chain) <= tolerance;
}

bool on_face_rim(const FaceOutline& face, const Vector2& place, double tolerance) {
  return on_chain(face.outer, place, tolerance) ||
         std::any_of(face.inner.begin(), face.inner.end(),
                     [&](const NodeChain& hole) { return on_chain(hole, place, tolerance); });
}

/// Whether the face stands for the section around it: at each rim either nothing rises from it (the top of a
/// box), or patches below meet it all around (two boxes stacked edge on edge).
bool is_cap(const Section& section, const FaceOutline& face, const std::vector<Edge>& below,
            const std::vector<Edge>& above, double tolerance) {
  const auto stands_for = [&](const NodeChain& rim) {
    bool none_above = true;
    bool all_below = true;
    for (std::size_t k = 0; k < rim.nodes.size() && (none_above || all_below); ++k) {
      const Vector2 middle = 0.5 * (rim.nodes[k].position + rim.nodes[(k + 1) % rim.nodes.size()].position);
      none_above = none_above && count_on(section, above, middle, tolerance) == 0;
      all_below = all_below && count_on(section, below, middle, tolerance) > 0;
    }
    return none_above || all_below;
  };
  return stands_for(face.outer) && std::all_of(face.inner.begin(), face.inner.end(), stands_for);
}

bool inside_face(const FaceOutline& face, const Vector2& place) {
  return contains(loop_of(face.outer), place) &&
         std::none_of(face.inner.begin(), face.inner.end(),
                      [&](const NodeChain& hole) { return contains(loop_of(hole), place); });
}

}  // namespace

double distance_to_chain(const Vector2& place, const NodeChain& chain) {
  double best = std::numeric_limits<double>::infinity();
  const std::size_t count = chain.nodes.size() - (chain.closed ? 0 : 1);
  for (std::size_t s = 0; s < count; ++s) {
    best = std::min(best, squared_distance(place, chain.nodes[s].position,
                                           chain.nodes[s + 1 == chain.nodes.size() ? 0 : s + 1].position));
  }
  return std::sqrt(best);
}

InPlane sort_out_in_plane(const Section& section, const InPlaneOptions& options) {
  const double tolerance = options.coincident;
  InPlane result;
  std::vector<Edge> below;
  std::vector<Edge> above;
  for (const SectionArc& arc : section.arcs) {
    switch (arc.kind) {
      case ArcKind::kEdgeBelow:
        below.push_back(make_edge(section, arc));
        break;
      case ArcKind::kEdgeAbove:
        above.push_back(make_edge(section, arc));
        break;
      default:
        result.section_arcs.push_back(arc);
        break;
    }
  }
  for (const TouchCandidate& touch : section.touches) result.touch_points.push_back(touch.position);
  if (below.empty() && above.empty() && section.flats.empty()) return result;

  std::vector<FaceOutline> caps;
  for (FaceOutline& face : face_outlines(section)) {
    if (face_width(face) < options.epsilon) {
      add_grazed(face, options.epsilon, result);
      continue;
    }
    if (is_cap(section, face, below, above, tolerance)) caps.push_back(face);
    result.faces.push_back(std::move(face));
  }
  const auto on_any = [&](const std::vector<FaceOutline>& faces, const Vector2& place) {
    return std::any_of(faces.begin(), faces.end(),
                       [&](const FaceOutline& face) { return on_face_rim(face, place, tolerance); });
  };

  const auto inside_any = [&](const Vector2& place) {
    return std::any_of(result.faces.begin(), result.faces.end(),
                       [&](const FaceOutline& face) { return inside_face(face, place); });
  };

  std::vector<SectionArc> touch_arcs;
  for (std::size_t k = 0; k < below.size(); ++k) {
    const Vector2& middle = below[k].middle;
    if (on_any(caps, middle) || repeats_earlier(section, below, k, tolerance)) continue;
    const std::size_t partners = count_on(section, below, middle, tolerance) - 1;
    const bool wall_above = count_on(section, above, middle, tolerance) > 0;
    // Two patches below: the plane grazes a ridge. One alone is the rim of an open model.
    if ((partners == 0 && below[k].arc.upright) || wall_above || on_any(result.faces, middle)) {
      result.section_arcs.push_back(below[k].arc);
    } else if (!inside_any(middle)) {
      touch_arcs.push_back(below[k].arc);
    }
  }
  for (std::size_t k = 0; k < above.size(); ++k) {
    const Vector2& middle = above[k].middle;
    if (on_any(result.faces, middle) || inside_any(middle) ||
        count_on(section, below, middle, tolerance) > 0 || repeats_earlier(section, above, k, tolerance)) {
      continue;
    }
    const bool rim = above[k].arc.upright && count_on(section, above, middle, tolerance) == 1;
    (rim ? result.section_arcs : touch_arcs).push_back(above[k].arc);
  }
  for (NodeChain& chain : link_arcs(section, touch_arcs, options.joined).chains)
    result.touch_curves.push_back(std::move(chain));
  return result;
}

}  // namespace lamina::engine
