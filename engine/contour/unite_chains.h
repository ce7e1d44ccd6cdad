#pragma once

#include <cstddef>
#include <vector>

#include "engine/contour/contour_node.h"

namespace lamina::engine {

/// What chains that meet bound together.
struct UnitedChains {
  std::vector<NodeChain>
      outlines;                 ///< closed, solid on the left; they meet each other at single points at most
  std::vector<NodeChain> open;  ///< pieces that bound nothing and lie outside the solid
  std::size_t dropped_pieces = 0;  ///< pieces inside the solid, and stubs
  double dropped_length = 0.0;     ///< mm
};

/// The outline of the union of what the chains bound. Where two chains cross, the outline has a corner at the
/// crossing of their curves, found by Newton steps on cubics through the nodes and tangents. Dead ends
/// shorter than `shortest_open` (mm) or inside the solid are dropped and counted.
UnitedChains unite_chains(const std::vector<NodeChain>& chains, double shortest_open);

/// Outlines, interior on the left, of where at least `least_cover` of the regions lie on top of each other
/// that closed chains bound; every chain runs with its region on the left. The same for chains that cross,
/// touch or coincide.
std::vector<NodeChain> covered_outlines(const std::vector<NodeChain>& chains, int least_cover);

}  // namespace lamina::engine
