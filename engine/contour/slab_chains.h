#pragma once

#include <vector>

#include "engine/contour/layer_chains.h"
#include "engine/slice_options.h"

namespace lamina::engine {

/// Closed chains turned so that the area which they bound by parity lies on their left.
std::vector<NodeChain> turned_by_parity(std::vector<NodeChain> chains);

/// What all sections through one slab cover together (positive) or each of them (negative), from those at
/// several heights; closed chains, the interior on the left. Strips narrower than `least_width` (mm) are left
/// out.
std::vector<NodeChain> contain_sections(const std::vector<LayerChains>& sections, Containment containment,
                                        double least_width);

/// How far a section's closed contours reach out of a positive layer, or into a negative one, at their nodes,
/// mm; infinite where the layer is empty and the section is not to be so.
double breach(const std::vector<NodeChain>& outlines, const LayerChains& section, Containment containment);

}  // namespace lamina::engine
