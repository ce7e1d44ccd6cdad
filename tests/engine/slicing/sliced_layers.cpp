#include "tests/engine/slicing/sliced_layers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/pointcloud/facet_front.h"
#include "engine/pointcloud/patch_front.h"

namespace lamina::tests {

using engine::Loop;
using engine::Vector2;

ReportedChains reported_chains_at(const engine::Model& model, double z, const engine::SliceOptions& options) {
  engine::PatchFront patches(model);
  patches.advance(z, engine::kModelTolerance);
  engine::FacetFront facets(model);
  facets.advance(z, engine::kModelTolerance);
  engine::FrontState front = patches.state();
  front.facets = facets.active();
  ReportedChains result;
  result.chains = engine::LayerMaker(options).chains(front, z, result.report);
  return result;
}

engine::LayerChains chains_at(const engine::Model& model, double z, double epsilon,
                              const engine::SliceOptions& options) {
  engine::SliceOptions with_epsilon = options;
  with_epsilon.epsilon = epsilon;
  return reported_chains_at(model, z, with_epsilon).chains;
}

std::vector<Loop> loops_of(const engine::LayerChains& chains) {
  std::vector<Loop> loops;
  for (const engine::NodeChain& chain : chains.closed) {
    loops.emplace_back();
    for (const engine::ContourNode& node : chain.nodes) loops.back().push_back(node.position);
  }
  return loops;
}

double distance_to_loops(const Vector2& point, const std::vector<Loop>& loops) {
  double best = std::numeric_limits<double>::infinity();
  for (const Loop& loop : loops) {
    for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
      const Vector2 along = loop[i] - loop[j];
      const double t =
          std::clamp((point - loop[j]).dot(along) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
      best = std::min(best, (loop[j] + t * along - point).norm());
    }
  }
  return best;
}

double greatest_difference(const std::vector<Loop>& a, const std::vector<Loop>& b) {
  double greatest = 0.0;
  for (const Loop& loop : a) {
    for (const Vector2& point : loop) greatest = std::max(greatest, distance_to_loops(point, b));
  }
  for (const Loop& loop : b) {
    for (const Vector2& point : loop) greatest = std::max(greatest, distance_to_loops(point, a));
  }
  return greatest;
}

}  // namespace lamina::tests
