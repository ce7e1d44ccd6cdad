#pragma once

#include <vector>

#include "engine/contour/contour_node.h"

namespace lamina::engine {

/// Outlines of what several solids cover together, each given by closed chains that nest by parity: a solid
/// inside another one, or in a hole that it fills, is material. Solids apart from all others keep their
/// chains as they are; otherwise the interior is on the left. Holes between solids of a mean width below
/// `narrowest_hole` (mm) are closed: chords of two surfaces that coincide need not.
std::vector<NodeChain> unite_solids(std::vector<std::vector<NodeChain>> solids, double narrowest_hole);

}  // namespace lamina::engine
