#include "engine/contour/unite_solids.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/contour/node_chain.h"
#include "engine/contour/slab_chains.h"
#include "engine/contour/unite_chains.h"
#include "engine/geometry/polygon.h"
#include "engine/model.h"

namespace lamina::engine {
namespace {

/// Around the chains and what touches them; empty without any.
Box2 box_of(const std::vector<NodeChain>& chains) {
  Box2 box;
  for (const NodeChain& chain : chains) {
    for (const ContourNode& node : chain.nodes) box.extend(node.position);
  }
  if (box.isEmpty()) return box;
  const Vector2 margin = Vector2::Constant(kModelTolerance);
  return {box.min() - margin, box.max() + margin};
}

void append(std::vector<NodeChain>& chains, std::vector<NodeChain> more) {
  std::move(more.begin(), more.end(), std::back_inserter(chains));
}

}  // namespace

std::vector<NodeChain> unite_solids(std::vector<std::vector<NodeChain>> solids, double narrowest_hole) {
  std::vector<Box2> boxes;
  for (const std::vector<NodeChain>& solid : solids) boxes.push_back(box_of(solid));
  std::vector<NodeChain> result;
  std::vector<bool> done(solids.size(), false);
  for (std::size_t first = 0; first < solids.size(); ++first) {
    if (done[first]) continue;
    // All whose boxes meet, from one to the next.
    std::vector<std::size_t> group{first};
    done[first] = true;
    for (std::size_t k = 0; k < group.size(); ++k) {
      for (std::size_t other = first + 1; other < solids.size(); ++other) {
        if (done[other] || !boxes[group[k]].intersects(boxes[other])) continue;
        done[other] = true;
        group.push_back(other);
      }
    }
    if (group.size() == 1) {
      append(result, std::move(solids[first]));
      continue;
    }
    std::sort(group.begin(), group.end());
    std::vector<NodeChain> chains;
    for (const std::size_t solid : group) append(chains, turned_by_parity(std::move(solids[solid])));
    std::vector<NodeChain> outlines = covered_outlines(chains, 1);
    std::erase_if(outlines, [&](const NodeChain& outline) {
      return mean_width(outline) < narrowest_hole && signed_area(loop_of(outline)) < 0.0;
    });
    append(result, std::move(outlines));
  }
  return result;
}

}  // namespace lamina::engine
