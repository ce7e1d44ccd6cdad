#pragma once

#include <cstddef>
#include <vector>

#include "engine/contour/contour_node.h"
#include "engine/pointcloud/section_arc.h"

namespace lamina::engine {

/// Arcs put end to end, and how they were found to be connected.
struct LinkedChains {
  std::vector<NodeChain> chains;
  std::size_t branchings = 0;    ///< places where more than two arcs meet
  std::size_t dropped_arcs = 0;  ///< shorter than the tolerance, both ends in one place
};

/// Joins arcs whose ends lie within `tolerance` (mm) of each other into chains, each as long as it gets.
/// Where more than two ends meet, those that continue each other most straightly are joined. A chain runs the
/// way that most of its length is directed. A node where two arcs meet at an angle is a corner.
LinkedChains link_arcs(const Section& section, const std::vector<SectionArc>& arcs, double tolerance);

/// Whether tangents turn so much at a node that the curve has a corner there.
bool is_corner(const Vector2& tangent_in, const Vector2& tangent_out);

/// The same chain walked the other way.
void reverse(NodeChain& chain);

}  // namespace lamina::engine
