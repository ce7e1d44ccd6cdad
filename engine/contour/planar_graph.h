#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/contour/contour_node.h"

namespace lamina::engine {

/// A point of the snapping lattice, whose spacing is about the model tolerance.
struct LatticePoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
  auto operator<=>(const LatticePoint&) const = default;
};

/// Part of a segment of a chain, in the segment's direction.
struct ChainPart {
  std::uint32_t chain = 0;
  std::uint32_t segment = 0;
  bool forward = true;  ///< the chain runs from the edge's `a` to its `b`
};

/// An edge of the graph: parts of one or more chains that coincide on the lattice.
struct GraphEdge {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  std::vector<ChainPart> parts;
};

/// The chains drawn into the plane together: no edge crosses or touches another but at their vertices.
struct PlanarGraph {
  std::vector<LatticePoint> vertices;
  std::vector<GraphEdge> edges;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> crossings;  ///< pairs of chains that cross properly
};

LatticePoint lattice_point(const Vector2& position);
Vector2 position_of(LatticePoint point);

/// Draws chains. Points are rounded to the lattice, segments are split where they cross, where a vertex lies
/// on them within a lattice step, and where they overlap, until nothing is left to split (iterated snap
/// rounding; Hobby, Practical segment intersection with finite precision output, 1999). All decisions are
/// exact in integers.
PlanarGraph draw_planar_graph(const std::vector<NodeChain>& chains);

/// Wide enough for products of lattice coordinates of any model up to kilometres.
__extension__ using WideInteger = __int128;

/// Twice the signed area of the triangle a, b, c in lattice steps: positive when it turns left. Exact.
inline WideInteger turn(LatticePoint a, LatticePoint b, LatticePoint c) {
  return static_cast<WideInteger>(b.x - a.x) * (c.y - a.y) -
         static_cast<WideInteger>(b.y - a.y) * (c.x - a.x);
}

}  // namespace lamina::engine
