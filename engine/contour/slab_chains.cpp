#include "engine/contour/slab_chains.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "engine/contour/link_arcs.h"
#include "engine/contour/node_chain.h"
#include "engine/contour/region_probe.h"
#include "engine/contour/unite_chains.h"
#include "engine/geometry/polygon.h"

namespace lamina::engine {
std::vector<NodeChain> turned_by_parity(std::vector<NodeChain> chains) {
  std::vector<RegionProbe> probes;
  probes.reserve(chains.size());
  for (const NodeChain& chain : chains) probes.emplace_back(std::vector<NodeChain>{chain});
  for (std::size_t c = 0; c < chains.size(); ++c) {
    bool hole = false;
    for (std::size_t other = 0; other < chains.size(); ++other) {
      if (other != c && probes[other].contains(chains[c].nodes.front().position)) hole = !hole;
    }
    if ((signed_area(loop_of(chains[c])) > 0.0) == hole) reverse(chains[c]);
  }
  return chains;
}

double breach(const std::vector<NodeChain>& outlines, const LayerChains& section, Containment containment) {
  const RegionProbe probe(outlines);
  double deepest = 0.0;
  for (const NodeChain& chain : section.closed) {
    for (const ContourNode& node : chain.nodes) {
      // Nodes of a section lie in the positive layer and beside the negative one.
      if (probe.contains(node.position) == (containment == Containment::kPositive)) continue;
      deepest = std::max(deepest, probe.distance(node.position));
    }
  }
  return deepest;
}

std::vector<NodeChain> contain_sections(const std::vector<LayerChains>& sections, Containment containment,
                                        double least_width) {
  const bool positive = containment == Containment::kPositive;
  std::vector<NodeChain> chains;
  const auto append = [&](std::vector<NodeChain> more) {
    std::move(more.begin(), more.end(), std::back_inserter(chains));
  };
  for (const LayerChains& section : sections) {
    append(turned_by_parity(section.closed));
    if (!positive) continue;  // a level face is the end of the solid: no section beside it has to have it
    for (const LayerChains::Face& face : section.faces) {
      append({face.outer});
      append(face.inner);
    }
  }
  std::vector<NodeChain> outlines =
      covered_outlines(chains, positive ? 1 : static_cast<int>(sections.size()));
  std::erase_if(outlines, [&](const NodeChain& outline) { return mean_width(outline) < least_width; });
  return outlines;
}

}  // namespace lamina::engine
