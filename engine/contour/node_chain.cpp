#include "engine/contour/node_chain.h"

#include <cmath>

namespace lamina::engine {

Loop loop_of(const NodeChain& chain) {
  Loop loop;
  loop.reserve(chain.nodes.size());
  for (const ContourNode& node : chain.nodes) loop.push_back(node.position);
  return loop;
}

double length_of(const NodeChain& chain) {
  double length = 0.0;
  for (std::size_t k = 1; k < chain.nodes.size(); ++k) {
    length += (chain.nodes[k].position - chain.nodes[k - 1].position).norm();
  }
  if (chain.closed) length += (chain.nodes.front().position - chain.nodes.back().position).norm();
  return length;
}

double mean_width(const NodeChain& outline) {
  const Loop loop = loop_of(outline);
  return 2.0 * std::abs(signed_area(loop)) / perimeter(loop);
}

}  // namespace lamina::engine
