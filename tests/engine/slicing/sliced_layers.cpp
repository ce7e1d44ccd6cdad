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

Kinds kinds_of(const engine::Layer& layer, double tolerance) {
  Kinds kinds;
  std::vector<Loop> loops;
  for (const engine::ClosedContour& contour : layer.closed) {
    if (contour.touch) {
      ++kinds.touching;
    } else {
      loops.push_back(engine::flatten(contour.curve, tolerance));
    }
  }
  for (const engine::OpenContour& contour : layer.open) ++(contour.touch ? kinds.touching : kinds.open);
  kinds.closed = loops.size();
  kinds.planar = layer.planar.size();
  for (const engine::PlanarContour& contour : layer.planar) kinds.holes += contour.inner.size();
  kinds.points = layer.points.size();
  for (const Loop& loop : loops) {
    std::size_t depth = 0;
    const Vector2& p = loop.front();
    for (const Loop& around : loops) {
      if (&around == &loop) continue;
      bool inside = false;
      for (std::size_t i = 0, j = around.size() - 1; i < around.size(); j = i++) {
        const Vector2& a = around[i];
        const Vector2& b = around[j];
        if ((a.y() > p.y()) != (b.y() > p.y()) &&
            p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) {
          inside = !inside;
        }
      }
      depth += inside ? 1 : 0;
    }
    kinds.depths.push_back(depth);
  }
  std::sort(kinds.depths.begin(), kinds.depths.end());
  return kinds;
}

}  // namespace lamina::tests
