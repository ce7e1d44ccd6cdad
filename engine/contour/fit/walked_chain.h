#pragma once

#include <cstddef>
#include <vector>

#include "engine/contour/fit/smooth_chain.h"
#include "engine/contour/fit/spline_system.h"

namespace lamina::engine {

/// A smooth chain and the way along it, mm. Refers to the chain, which must outlive it.
struct WalkedChain {
  explicit WalkedChain(const SmoothChain& smooth);

  const SmoothChain& chain;
  std::vector<double> lengths;  ///< of the segments
  std::vector<double> walked;   ///< up to each node

  std::size_t segments() const { return lengths.size(); }
};

/// Calls `visit(position, tangent, walked)` for every node but the last, for `parts - 1` places of the cubic
/// behind each, and for the last node; in order, positions relative to the first node.
template <typename Visit>
void for_each_place(const WalkedChain& walk, std::size_t stride, std::size_t parts, Visit&& visit) {
  const SmoothChain& chain = walk.chain;
  const Vector2 origin = chain.positions.front();
  for (std::size_t i = 0; i < walk.segments(); i += stride) {
    visit(Vector2(chain.positions[i] - origin), chain.tangents[i], walk.walked[i]);
    if (parts < 2) continue;
    const Cubic cubic = hermite_cubic(chain, i);
    for (std::size_t k = 1; k < parts; ++k) {
      const double u = static_cast<double>(k) / static_cast<double>(parts);
      visit(Vector2(point_on(cubic, u) - origin), Vector2(derivative_on(cubic, u).normalized()),
            walk.walked[i] + u * walk.lengths[i]);
    }
  }
  visit(Vector2(chain.positions.back() - origin), chain.tangents.back(), walk.walked.back());
}

/// About `wanted` samples or more, positions relative to the first node, parameters the way along: some of
/// the nodes, or all of them and places of the cubics in between.
std::vector<FitSample> samples_of(const WalkedChain& walk, std::size_t wanted);

}  // namespace lamina::engine
