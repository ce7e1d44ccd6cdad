#include "engine/contour/unite_chains.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

#include "engine/contour/chain_orientation.h"
#include "engine/contour/link_arcs.h"
#include "engine/contour/node_chain.h"
#include "engine/contour/planar_faces.h"
#include "engine/contour/region_probe.h"
#include "engine/contour/segment_curve.h"

namespace lamina::engine {
namespace {

/// The edge of an outline as a piece of one chain's segment.
struct Step {
  std::uint32_t half = 0;
  ChainPart part;       ///< the chain that it follows
  bool forward = true;  ///< the outline runs the way of that chain
};

class Outliner {
 public:
  Outliner(const std::vector<NodeChain>& chains, const PlanarGraph& graph) : chains_(chains), graph_(graph) {}

  /// The part of an edge that continues the step before it, else the first.
  Step step_along(std::uint32_t half, const Step* before) const {
    const std::vector<ChainPart>& parts = graph_.edges[half / 2].parts;
    const ChainPart* chosen = &parts.front();
    if (before != nullptr) {
      for (const ChainPart& part : parts) {
        if (part.chain == before->part.chain) {
          chosen = &part;
          break;
        }
      }
    }
    return {half, *chosen, chosen->forward == (half % 2 == 0)};
  }

  SegmentCurve curve(const ChainPart& part) const { return SegmentCurve(chains_[part.chain], part.segment); }

  /// Node number of the chain that begins (or ends) a segment.
  std::size_t node_before(const ChainPart& part) const { return part.segment; }
  std::size_t node_after(const ChainPart& part) const {
    return part.segment + 1 == chains_[part.chain].nodes.size() ? 0 : part.segment + 1;
  }

  /// The outline's node between two steps, or nothing where the second continues the segment of the first.
  void add_node(const Step& in, const Step& out, NodeChain& outline) const {
    const bool same_run = in.part.chain == out.part.chain && in.forward == out.forward;
    if (same_run && in.part.segment == out.part.segment) return;
    const LatticePoint vertex = graph_.vertices[start_of(graph_, out.half)];
    const NodeChain& chain = chains_[in.part.chain];
    if (same_run) {
      const std::size_t reached = in.forward ? node_after(in.part) : node_before(in.part);
      const std::size_t left = out.forward ? node_before(out.part) : node_after(out.part);
      if (reached == left && lattice_point(chain.nodes[reached].position) == vertex) {
        ContourNode node = chain.nodes[reached];
        if (!in.forward) {
          const Vector2 tangent = -node.tangent_out;
          node.tangent_out = -node.tangent_in;
          node.tangent_in = tangent;
        }
        outline.nodes.push_back(node);
        return;
      }
    }
    // Another chain takes over.
    const SegmentCurve curve_in = curve(in.part);
    const SegmentCurve curve_out = curve(out.part);
    const Vector2 place = position_of(vertex);
    const CurveMeeting meeting = meet(curve_in, curve_out, place);
    ContourNode node;
    node.position = meeting.position;
    node.tangent_in = (in.forward ? 1.0 : -1.0) * curve_in.tangent(meeting.first);
    node.tangent_out = (out.forward ? 1.0 : -1.0) * curve_out.tangent(meeting.second);
    node.corner = is_corner(node.tangent_in, node.tangent_out);
    node.exact = chain.nodes[in.part.segment].exact || chain.nodes[node_after(in.part)].exact;
    outline.nodes.push_back(node);
  }

  NodeChain outline(const std::vector<std::uint32_t>& halves) const {
    std::vector<Step> steps;
    for (const std::uint32_t half : halves)
      steps.push_back(step_along(half, steps.empty() ? nullptr : &steps.back()));
    NodeChain result;
    result.closed = true;
    for (std::size_t k = 0; k < steps.size(); ++k)
      add_node(steps[k == 0 ? steps.size() - 1 : k - 1], steps[k], result);
    return result;
  }

 private:
  const std::vector<NodeChain>& chains_;
  const PlanarGraph& graph_;
};

/// Closed walks along half-edges with the solid on the left and none on the right; the solid is the faces
/// that are `filled`. At a vertex the walk stays beside the same part of the solid, so solids that touch in a
/// point keep their own outlines.
std::vector<std::vector<std::uint32_t>> outline_walks(const PlanarGraph& graph, const PlanarFaces& faces,
                                                      const std::vector<bool>& filled) {
  std::vector<bool> on_outline(2 * graph.edges.size(), false);
  for (std::uint32_t half = 0; half < on_outline.size(); ++half) {
    if (faces.dangling[half / 2]) continue;
    on_outline[half] = filled[faces.face[half]] && !filled[faces.face[half ^ 1U]];
  }
  std::vector<std::vector<std::uint32_t>> walks;
  std::vector<bool> used(on_outline.size(), false);
  for (std::uint32_t first = 0; first < on_outline.size(); ++first) {
    if (!on_outline[first] || used[first]) continue;
    std::vector<std::uint32_t> walk;
    for (std::uint32_t half = first; !used[half];) {
      used[half] = true;
      walk.push_back(half);
      const std::uint32_t back = half ^ 1U;
      const auto& out = faces.out[start_of(graph, back)];
      std::size_t k = faces.place[back];
      do {
        k = (k + out.size() - 1) % out.size();
      } while (!on_outline[out[k]]);
      half = out[k];
    }
    walks.push_back(std::move(walk));
  }
  return walks;
}

/// Dead ends, and edges that lead from one closed walk to another through one and the same face.
bool bounds_nothing(const PlanarFaces& faces, std::uint32_t edge) {
  return faces.dangling[edge] || faces.face[2 * edge] == faces.face[2 * edge + 1];
}

/// What bounds nothing, as pieces of their chains, cut where they meet what does bound.
std::vector<NodeChain> unbounding_pieces(const std::vector<NodeChain>& chains, const PlanarGraph& graph,
                                         const PlanarFaces& faces) {
  struct Part {
    std::uint32_t chain, segment;
    double place;
    Vector2 from, to;
    bool begins;  ///< at an edge that bounds
  };
  std::vector<bool> bounding(graph.vertices.size(), false);
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    if (!bounds_nothing(faces, e)) bounding[graph.edges[e].a] = bounding[graph.edges[e].b] = true;
  }
  std::vector<Part> parts;
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    if (!bounds_nothing(faces, e)) continue;
    const ChainPart& part = graph.edges[e].parts.front();
    std::uint32_t a = graph.edges[e].a;
    std::uint32_t b = graph.edges[e].b;
    if (!part.forward) std::swap(a, b);
    const Vector2 from = position_of(graph.vertices[a]);
    parts.push_back({part.chain, part.segment,
                     (from - chains[part.chain].nodes[part.segment].position).norm(), from,
                     position_of(graph.vertices[b]), bounding[a]});
  }
  std::sort(parts.begin(), parts.end(), [](const Part& p, const Part& q) {
    return std::tie(p.chain, p.segment, p.place) < std::tie(q.chain, q.segment, q.place);
  });
  std::vector<NodeChain> pieces;
  const Part* before = nullptr;
  for (const Part& part : parts) {
    if (before == nullptr || before->chain != part.chain || !(before->to == part.from) || part.begins) {
      pieces.emplace_back();
      ContourNode start;
      start.position = part.from;
      start.corner = true;
      pieces.back().nodes.push_back(start);
    }
    ContourNode node;
    node.position = part.to;
    const NodeChain& chain = chains[part.chain];
    const std::size_t after = (part.segment + 1) % chain.nodes.size();
    if (lattice_point(chain.nodes[after].position) == lattice_point(part.to)) {
      node = chain.nodes[after];
      node.position = part.to;
    } else {
      node.corner = true;
    }
    pieces.back().nodes.push_back(node);
    before = &part;
  }
  return pieces;
}

std::vector<NodeChain> outlines_of(const std::vector<NodeChain>& chains, const PlanarGraph& graph,
                                   const PlanarFaces& faces, const std::vector<bool>& filled) {
  std::vector<NodeChain> outlines;
  const Outliner outliner(chains, graph);
  for (const std::vector<std::uint32_t>& walk : outline_walks(graph, faces, filled)) {
    NodeChain outline = outliner.outline(walk);
    if (outline.nodes.size() >= 2) outlines.push_back(std::move(outline));
  }
  return outlines;
}

}  // namespace

std::vector<NodeChain> covered_outlines(const std::vector<NodeChain>& chains, int least_cover) {
  const PlanarGraph graph = draw_planar_graph(chains);
  const PlanarFaces faces = find_faces(graph);
  const std::vector<int> winding = face_windings(graph, faces, std::vector<int>(chains.size(), 1));
  std::vector<bool> filled;
  filled.reserve(winding.size());
  for (const int cover : winding) filled.push_back(cover >= least_cover);
  return outlines_of(chains, graph, faces, filled);
}

UnitedChains unite_chains(const std::vector<NodeChain>& chains, double shortest_open) {
  const PlanarGraph graph = draw_planar_graph(chains);
  const PlanarFaces faces = find_faces(graph);
  const std::vector<int> winding = face_windings(graph, faces, chain_orientations(chains, graph, faces));

  UnitedChains result;
  std::vector<bool> filled;
  filled.reserve(winding.size());
  for (const int cover : winding) filled.push_back(cover != 0);
  result.outlines = outlines_of(chains, graph, faces, filled);
  const RegionProbe solid(result.outlines);
  for (NodeChain& piece : unbounding_pieces(chains, graph, faces)) {
    const double length = length_of(piece);
    const Vector2 middle = piece.nodes[piece.nodes.size() / 2].position;
    const Vector2 before = piece.nodes[(piece.nodes.size() - 1) / 2].position;
    if (length < shortest_open || solid.contains(0.5 * (middle + before))) {
      ++result.dropped_pieces;
      result.dropped_length += length;
    } else {
      result.open.push_back(std::move(piece));
    }
  }
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    if (bounds_nothing(faces, e) || filled[faces.face[2 * e]] != filled[faces.face[2 * e + 1]]) continue;
    result.dropped_length +=
        (position_of(graph.vertices[graph.edges[e].a]) - position_of(graph.vertices[graph.edges[e].b]))
            .norm();
  }
  return result;
}

}  // namespace lamina::engine
