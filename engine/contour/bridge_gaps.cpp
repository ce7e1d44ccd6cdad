#include "engine/contour/bridge_gaps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "engine/contour/in_plane.h"
#include "engine/contour/link_arcs.h"
#include "engine/contour/node_chain.h"
#include "engine/grid/point_index.h"

namespace lamina::engine {
namespace {

constexpr std::uint32_t kNone = PointIndex::kNone;
/// Ends are led to the middle of another chain, and to an end that they pass sideways, over this many epsilon
/// at most: a fin that points at a wall from afar, or a wall that overshoots its corner, is none of their
/// business.
constexpr double kLongestLead = 10.0;
/// A chain is bent back to where it begins only over gaps that are shorter than this part of it.
constexpr double kBentBack = 1.0 / 3.0;

/// End 2c is the front of chain c, end 2c + 1 its back.
const ContourNode& end_node(const std::vector<NodeChain>& chains, std::uint32_t end) {
  const NodeChain& chain = chains[end / 2];
  return end % 2 == 0 ? chain.nodes.front() : chain.nodes.back();
}

/// Marks both ends of a bridge; it runs straight across, whatever the tangents of what it joins.
void mark_bridge(ContourNode& from, ContourNode& to) {
  from.corner = to.corner = true;
  from.exact = to.exact = false;
  from.tangent_out = to.tangent_in = (to.position - from.position).normalized();
}

/// Appends `tail` to `chain`, whose ends lie `gap` apart.
void join(NodeChain& chain, const NodeChain& tail, double joined) {
  ContourNode& last = chain.nodes.back();
  const ContourNode& next = tail.nodes.front();
  const double gap = (next.position - last.position).norm();
  std::size_t first = 0;
  if (gap <= joined) {
    last.tangent_out = next.tangent_out;
    last.corner = is_corner(last.tangent_in, last.tangent_out);
    first = 1;
  }
  const std::size_t joint = chain.nodes.size();
  chain.nodes.insert(chain.nodes.end(), tail.nodes.begin() + static_cast<std::ptrdiff_t>(first),
                     tail.nodes.end());
  if (first == 0) mark_bridge(chain.nodes[joint - 1], chain.nodes[joint]);
  chain.normals_right += tail.normals_right;
}

void close(NodeChain& chain, double joined) {
  ContourNode& last = chain.nodes.back();
  ContourNode& first = chain.nodes.front();
  chain.closed = true;
  if ((first.position - last.position).norm() <= joined) {
    first.tangent_in = last.tangent_in;
    first.corner = is_corner(first.tangent_in, first.tangent_out);
    chain.nodes.pop_back();
  } else {
    mark_bridge(last, first);
  }
}

struct Pair {
  double distance;
  std::uint32_t a;
  std::uint32_t b;
};

/// Unit direction in which a chain would go on beyond its end; zero when unknown.
Vector2 onwards(const std::vector<NodeChain>& chains, std::uint32_t end) {
  const NodeChain& chain = chains[end / 2];
  const Vector2 tangent =
      end % 2 == 0 ? Vector2(-chain.nodes.front().tangent_out) : chain.nodes.back().tangent_in;
  if (tangent.squaredNorm() > 0.0 || chain.nodes.size() < 2) return tangent;
  const ContourNode& next = end % 2 == 0 ? chain.nodes[1] : chain.nodes[chain.nodes.size() - 2];
  return (end_node(chains, end).position - next.position).normalized();
}

/// Whether two chains go towards each other across their gap. Walls that overshoot a corner go away from it.
bool face_each_other(const std::vector<NodeChain>& chains, std::uint32_t a, std::uint32_t b) {
  const Vector2 across = end_node(chains, b).position - end_node(chains, a).position;
  return onwards(chains, a).dot(across) >= 0.0 && onwards(chains, b).dot(across) <= 0.0;
}

/// Pairs of free ends at most `reach` apart, the nearest first, each end once; those farther apart than
/// `any_way` only where they face each other.
std::vector<std::uint32_t> nearest_partners(const std::vector<NodeChain>& chains, double any_way,
                                            double reach) {
  std::vector<std::uint32_t> partner(2 * chains.size(), kNone);
  PointIndex index(reach);
  std::vector<std::uint32_t> ends;
  for (std::uint32_t end = 0; end < 2 * chains.size(); ++end) {
    if (chains[end / 2].closed || !end_node(chains, end).exact) continue;  // led to another chain already
    index.insert(end_node(chains, end).position);
    ends.push_back(end);
  }
  std::vector<Pair> pairs;
  for (std::uint32_t k = 0; k < ends.size(); ++k) {
    index.for_each_near(index.point(k), [&](std::uint32_t other) {
      if (other <= k) return;
      const double distance = (index.point(other) - index.point(k)).norm();
      if (distance > reach) return;
      if (distance > any_way && !face_each_other(chains, ends[k], ends[other])) return;
      if (ends[k] / 2 == ends[other] / 2 && distance > kBentBack * length_of(chains[ends[k] / 2])) return;
      pairs.push_back({distance, ends[k], ends[other]});
    });
  }
  std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) {
    return std::tie(x.distance, x.a, x.b) < std::tie(y.distance, y.a, y.b);
  });
  for (const Pair& pair : pairs) {
    if (partner[pair.a] != kNone || partner[pair.b] != kNone) continue;
    partner[pair.a] = pair.b;
    partner[pair.b] = pair.a;
  }
  return partner;
}

std::vector<NodeChain> joined_chains(std::vector<NodeChain> chains, const std::vector<std::uint32_t>& partner,
                                     double joined) {
  std::vector<NodeChain> result;
  std::vector<bool> used(chains.size(), false);
  const auto walk = [&](std::uint32_t start) {
    NodeChain whole;
    std::uint32_t end = start;
    while (end != kNone && !used[end / 2]) {
      NodeChain& piece = chains[end / 2];
      used[end / 2] = true;
      if (end % 2 != 0) reverse(piece);
      if (whole.nodes.empty()) {
        whole = std::move(piece);
      } else {
        join(whole, piece, joined);
      }
      end = partner[end ^ 1U];
    }
    if (end != kNone) close(whole, joined);
    result.push_back(std::move(whole));
  };
  for (std::uint32_t c = 0; c < chains.size(); ++c) {
    if (!chains[c].closed) continue;
    used[c] = true;
    result.push_back(std::move(chains[c]));
  }
  for (std::uint32_t end = 0; end < partner.size(); ++end) {
    if (!used[end / 2] && partner[end] == kNone) walk(end);
  }
  for (std::uint32_t c = 0; c < used.size(); ++c) {
    if (!used[c]) walk(2 * c);
  }
  return result;
}

std::size_t open_count(const std::vector<NodeChain>& chains) {
  return static_cast<std::size_t>(
      std::count_if(chains.begin(), chains.end(), [](const NodeChain& chain) { return !chain.closed; }));
}

/// Leads free ends to the nearest point of a chain's middle within reach; the end of a short fin not to the
/// chain that the fin stands on.
void lead_to_chains(BridgedChains& result, double reach, double joined) {
  std::vector<NodeChain>& chains = result.chains;
  const std::vector<NodeChain> before = chains;
  for (std::uint32_t end = 0; end < 2 * chains.size(); ++end) {
    if (before[end / 2].closed || !end_node(before, end).exact) continue;  // led there already
    const Vector2 place = end_node(before, end).position;
    const Vector2 other_end = end_node(before, end ^ 1U).position;
    const double farthest_back = kBentBack * length_of(before[end / 2]);
    double best = reach;
    Vector2 target = place;
    for (std::uint32_t c = 0; c < before.size(); ++c) {
      if (c == end / 2) continue;
      const NodeChain& chain = before[c];
      const double farthest =
          farthest_back < best && distance_to_chain(other_end, chain) <= joined ? farthest_back : best;
      const std::size_t count = chain.nodes.size() - (chain.closed ? 0 : 1);
      for (std::size_t s = 0; s < count; ++s) {
        const Vector2& a = chain.nodes[s].position;
        const Vector2& b = chain.nodes[(s + 1) % chain.nodes.size()].position;
        const Vector2 along = b - a;
        const double t = std::clamp((place - a).dot(along) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
        const Vector2 nearest = a + t * along;
        const double distance = (nearest - place).norm();
        if (distance < std::min(best, farthest)) {
          best = distance;
          target = nearest;
        }
      }
    }
    if (best >= reach || best == 0.0) continue;
    ContourNode node;
    node.position = target;
    NodeChain& chain = chains[end / 2];
    if (end % 2 == 0) {
      mark_bridge(node, chain.nodes.front());
      chain.nodes.insert(chain.nodes.begin(), node);
    } else {
      mark_bridge(chain.nodes.back(), node);
      chain.nodes.push_back(node);
    }
    result.bridges.push_back({place, target});
  }
}

/// The gaps between partners that are wider than `least`.
std::vector<BridgedGap> bridges_between(const std::vector<NodeChain>& chains,
                                        const std::vector<std::uint32_t>& partner, double least) {
  std::vector<BridgedGap> bridges;
  for (std::uint32_t end = 0; end < partner.size(); ++end) {
    if (partner[end] == kNone || partner[end] < end) continue;
    const BridgedGap gap{end_node(chains, end).position, end_node(chains, partner[end]).position};
    if (gap.width() > least) bridges.push_back(gap);
  }
  return bridges;
}

/// From each end that is left open to the nearest other one.
std::vector<BridgedGap> open_gaps(const std::vector<NodeChain>& chains) {
  std::vector<BridgedGap> gaps;
  for (std::uint32_t end = 0; end < 2 * chains.size(); ++end) {
    if (chains[end / 2].closed || !end_node(chains, end).exact) continue;
    const Vector2& place = end_node(chains, end).position;
    BridgedGap gap{place, place};
    double best = std::numeric_limits<double>::infinity();
    for (std::uint32_t other = 0; other < 2 * chains.size(); ++other) {
      if (other == end || chains[other / 2].closed) continue;
      const double distance = (end_node(chains, other).position - place).norm();
      if (distance < best) {
        best = distance;
        gap.to = end_node(chains, other).position;
      }
    }
    gaps.push_back(gap);
  }
  return gaps;
}

}  // namespace

BridgedChains bridge_gaps(std::vector<NodeChain> chains, const BridgeOptions& options) {
  BridgedChains result;
  result.chains = std::move(chains);
  const auto all_closed = [&result] { return open_count(result.chains) == 0; };
  const auto bridge = [&](double any_way, double reach) {
    const std::vector<std::uint32_t> partner = nearest_partners(result.chains, any_way, reach);
    const std::vector<BridgedGap> bridges = bridges_between(result.chains, partner, options.joined);
    result.bridges.insert(result.bridges.end(), bridges.begin(), bridges.end());
    result.chains = joined_chains(std::move(result.chains), partner, options.joined);
  };
  if (all_closed()) return result;
  bridge(options.epsilon, options.epsilon);
  if (all_closed()) return result;
  lead_to_chains(result, options.epsilon, options.joined);
  bridge(options.epsilon, options.longest_bridge);
  if (all_closed()) return result;
  const double lead = std::min(options.longest_bridge, kLongestLead * options.epsilon);
  lead_to_chains(result, lead, options.joined);
  bridge(lead, lead);
  result.open_gaps = open_gaps(result.chains);
  return result;
}

}  // namespace lamina::engine
