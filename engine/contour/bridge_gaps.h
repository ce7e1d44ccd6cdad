#pragma once

#include <vector>

#include "engine/contour/contour_node.h"
#include "engine/layer_report.h"

namespace lamina::engine {

struct BridgeOptions {
  double epsilon = 0.05;   ///< gaps up to this are no gaps; ends this near to another chain are led to it, mm
  double joined = 0.0005;  ///< ends this near become one node, mm
  double longest_bridge = 0.5;  ///< wider gaps stay open, mm
};

struct BridgedChains {
  std::vector<NodeChain> chains;
  std::vector<BridgedGap> bridges;    ///< wider than `joined`
  std::vector<BridgedGap> open_gaps;  ///< from each end left open to the nearest other one
};

/// Closes open chains: free ends are joined straight across, the narrowest gap first, up to epsilon; then
/// ends that stop short of the middle of another chain are led to it; then both once more with wider gaps, up
/// to the limit, the ends facing each other; last, over a few epsilon, ends that pass each other sideways.
BridgedChains bridge_gaps(std::vector<NodeChain> chains, const BridgeOptions& options);

}  // namespace lamina::engine
