#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/contour/planar_graph.h"

namespace lamina::engine {

/// The faces that a planar graph cuts the plane into. Half-edge 2e runs along edge e from a to b, 2e + 1
/// back. Edges that end nowhere (and what hangs on them) bound nothing and are left out.
struct PlanarFaces {
  static constexpr std::uint32_t kNone = 0xffffffff;

  std::vector<bool> dangling;  ///< of each edge
  std::vector<std::uint32_t>
      face;  ///< on the left of each half-edge; kNone for dangling ones. Face 0 is unbounded.
  std::vector<std::vector<std::uint32_t>>
      out;                           ///< of each vertex: half-edges that leave it, counter-clockwise
  std::vector<std::uint32_t> place;  ///< of each half-edge in its start vertex's `out`
  std::size_t face_count = 1;
};

inline std::uint32_t start_of(const PlanarGraph& graph, std::uint32_t half) {
  return half % 2 == 0 ? graph.edges[half / 2].a : graph.edges[half / 2].b;
}
inline std::uint32_t end_of(const PlanarGraph& graph, std::uint32_t half) {
  return start_of(graph, half ^ 1U);
}

PlanarFaces find_faces(const PlanarGraph& graph);

}  // namespace lamina::engine
