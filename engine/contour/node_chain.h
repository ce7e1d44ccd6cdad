#pragma once

#include "engine/contour/contour_node.h"
#include "engine/geometry/polygon.h"

namespace lamina::engine {

/// The nodes' positions; for a closed chain the loop that it is.
Loop loop_of(const NodeChain& chain);

/// Sum of the chords between nodes, the closing one of a closed chain included, mm.
double length_of(const NodeChain& chain);

/// Width of a strip with the area and length of the closed chain, mm.
double mean_width(const NodeChain& outline);

}  // namespace lamina::engine
