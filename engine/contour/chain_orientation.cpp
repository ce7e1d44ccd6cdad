#include "engine/contour/chain_orientation.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/contour/node_chain.h"
#include "engine/geometry/polygon.h"

namespace lamina::engine {
namespace {

/// Part of a chain's length along which the normals have to point to the same side to be believed, less that
/// along which they point to the other: facets that are turned over are few.
constexpr double kOneSided = 0.9;

double edge_length(const PlanarGraph& graph, const GraphEdge& edge) {
  return (position_of(graph.vertices[edge.a]) - position_of(graph.vertices[edge.b])).norm();
}

/// +1 where all chains whose orientation is known have their solid on the side that the normals point away
/// from, -1 where all have it on the other one; 0 where the normals contradict each other.
int side_of_solids(const std::vector<NodeChain>& chains, const std::vector<int>& orientations) {
  int side = 0;
  for (std::size_t c = 0; c < chains.size(); ++c) {
    if (std::abs(chains[c].normals_right) < kOneSided * length_of(chains[c])) return 0;
    if (orientations[c] == 0) continue;
    const int shown = chains[c].normals_right > 0.0 ? orientations[c] : -orientations[c];
    if (side == -shown) return 0;
    side = shown;
  }
  return side;
}

/// Whether a chain runs inside another one that it does not cross.
bool lies_in_another(const std::vector<NodeChain>& chains, const PlanarGraph& graph, std::size_t inner) {
  for (std::size_t outer = 0; outer < chains.size(); ++outer) {
    if (outer == inner || !chains[outer].closed) continue;
    const bool cross = std::any_of(graph.crossings.begin(), graph.crossings.end(), [&](const auto& pair) {
      return std::minmax<std::size_t>(pair.first, pair.second) == std::minmax(inner, outer);
    });
    if (!cross && contains(loop_of(chains[outer]), chains[inner].nodes.front().position)) return true;
  }
  return false;
}

}  // namespace

std::vector<int> chain_orientations(const std::vector<NodeChain>& chains, const PlanarGraph& graph,
                                    const PlanarFaces& faces) {
  // Length along which a chain has the outside on its right, less that along which it has it on its left.
  std::vector<double> vote(chains.size(), 0.0);
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    if (faces.dangling[e]) continue;
    const bool outside_left = faces.face[2 * e] == 0;
    const bool outside_right = faces.face[2 * e + 1] == 0;
    if (outside_left == outside_right) continue;
    const double length = edge_length(graph, graph.edges[e]);
    for (const ChainPart& part : graph.edges[e].parts)
      vote[part.chain] += part.forward == outside_right ? length : -length;
  }
  double normals_agree = 0.0;
  for (const double v : vote) normals_agree += v;

  std::vector<int> orientations(chains.size(), 0);
  for (std::size_t c = 0; c < chains.size(); ++c) {
    if (vote[c] != 0.0) orientations[c] = vote[c] > 0.0 ? 1 : -1;
  }
  const std::vector<int> bordering = orientations;
  const int normals = side_of_solids(chains, bordering);
  for (std::size_t c = 0; c < chains.size(); ++c) {
    if (bordering[c] != 0) continue;
    if (!chains[c].closed) {
      orientations[c] = normals_agree >= 0.0 ? 1 : -1;
      continue;
    }
    bool crosses = false;
    for (const auto& [a, b] : graph.crossings) crosses = crosses || a == c || b == c;
    const int filled = signed_area(loop_of(chains[c])) > 0.0 ? 1 : -1;
    const int shown = chains[c].normals_right < 0.0 ? -normals : normals;
    const bool hole = !crosses || (shown == -filled && lies_in_another(chains, graph, c));
    orientations[c] = hole ? -filled : filled;
  }
  return orientations;
}

std::vector<int> face_windings(const PlanarGraph& graph, const PlanarFaces& faces,
                               const std::vector<int>& orientations) {
  std::vector<std::vector<std::uint32_t>> halves_of(faces.face_count);
  for (std::uint32_t half = 0; half < faces.face.size(); ++half) {
    if (faces.face[half] != PlanarFaces::kNone) halves_of[faces.face[half]].push_back(half);
  }
  std::vector<int> winding(faces.face_count, 0);
  std::vector<bool> known(faces.face_count, false);
  std::vector<std::uint32_t> queue{0};
  known[0] = true;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const std::uint32_t face = queue[next];
    for (const std::uint32_t half : halves_of[face]) {
      const std::uint32_t across = faces.face[half ^ 1U];
      if (known[across]) continue;
      known[across] = true;
      // Left of a chain with its solid on the left the plane is covered once more than right of it.
      int step = 0;
      for (const ChainPart& part : graph.edges[half / 2].parts) {
        step += (part.forward == (half % 2 == 0) ? 1 : -1) * orientations[part.chain];
      }
      winding[across] = winding[face] - step;
      queue.push_back(across);
    }
  }
  return winding;
}

}  // namespace lamina::engine
