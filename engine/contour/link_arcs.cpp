#include "engine/contour/link_arcs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/grid/point_index.h"

namespace lamina::engine {
namespace {

/// Sine of the smallest turn that counts as a corner, about one degree: less is the noise of patches that
/// were fitted to be smooth.
constexpr double kCornerSine = 0.02;

constexpr std::uint32_t kNone = PointIndex::kNone;

/// Ends are numbered 2 * arc for the front, 2 * arc + 1 for the back.
struct Ends {
  const Section& section;
  const std::vector<SectionArc>& arcs;

  const SectionNode& node(std::uint32_t end) const {
    const SectionArc& arc = arcs[end / 2];
    return end % 2 == 0 ? section.front(arc) : section.back(arc);
  }
  /// Unit direction from the end into its arc.
  Vector2 inward(std::uint32_t end) const {
    const Vector2& tangent = node(end).tangent;
    if (tangent.squaredNorm() > 0.0) return end % 2 == 0 ? tangent : Vector2(-tangent);
    const SectionArc& arc = arcs[end / 2];
    const SectionNode& next = section.nodes[end % 2 == 0 ? arc.first + 1 : arc.first + arc.count - 2];
    return (next.position - node(end).position).normalized();
  }
};

double length_of(const Section& section, const SectionArc& arc) {
  double length = 0.0;
  for (std::uint32_t k = arc.first + 1; k < arc.first + arc.count; ++k) {
    length += (section.nodes[k].position - section.nodes[k - 1].position).norm();
  }
  return length;
}

/// Joins the ends at a branching, the straightest pair first.
void pair_at_branching(const Ends& ends, std::vector<std::uint32_t> meeting,
                       std::vector<std::uint32_t>& partner) {
  while (meeting.size() >= 2) {
    std::size_t best_a = 0;
    std::size_t best_b = 1;
    double best = 2.0;
    for (std::size_t a = 0; a < meeting.size(); ++a) {
      for (std::size_t b = a + 1; b < meeting.size(); ++b) {
        const double turn = ends.inward(meeting[a]).dot(ends.inward(meeting[b]));
        // Of equally straight pairs the one that keeps to a surface, then the one that keeps to the
        // direction.
        const bool same_surface = ends.arcs[meeting[a] / 2].surface == ends.arcs[meeting[b] / 2].surface;
        const bool same_way = meeting[a] % 2 != meeting[b] % 2;
        const double score = turn - (same_surface ? 1e-3 : 0.0) - (same_way ? 5e-4 : 0.0);
        if (score < best) {
          best = score;
          best_a = a;
          best_b = b;
        }
      }
    }
    partner[meeting[best_a]] = meeting[best_b];
    partner[meeting[best_b]] = meeting[best_a];
    meeting.erase(meeting.begin() + static_cast<std::ptrdiff_t>(best_b));
    meeting.erase(meeting.begin() + static_cast<std::ptrdiff_t>(best_a));
  }
}

/// Appends an arc's nodes, walked from one of its ends; the first node joins the chain's last.
void append(NodeChain& chain, const Section& section, const SectionArc& arc, bool reversed) {
  const double sign = reversed ? -1.0 : 1.0;
  const auto at = [&](std::uint32_t k) -> const SectionNode& {
    return section.nodes[reversed ? arc.first + arc.count - 1 - k : arc.first + k];
  };
  std::uint32_t first = 0;
  if (!chain.nodes.empty()) {
    ContourNode& joint = chain.nodes.back();
    joint.tangent_out = sign * at(0).tangent;
    joint.corner = is_corner(joint.tangent_in, joint.tangent_out);
    first = 1;
  }
  for (std::uint32_t k = first; k < arc.count; ++k) {
    const Vector2 tangent = sign * at(k).tangent;
    chain.nodes.push_back({at(k).position, tangent, tangent, tangent.squaredNorm() == 0.0, true});
  }
}

}  // namespace

bool is_corner(const Vector2& tangent_in, const Vector2& tangent_out) {
  const double cross = tangent_in.x() * tangent_out.y() - tangent_in.y() * tangent_out.x();
  return std::abs(cross) > kCornerSine || !(tangent_in.dot(tangent_out) > 0.0);
}

void reverse(NodeChain& chain) {
  std::reverse(chain.nodes.begin(), chain.nodes.end());
  for (ContourNode& node : chain.nodes) {
    const Vector2 in = -node.tangent_out;
    node.tangent_out = -node.tangent_in;
    node.tangent_in = in;
  }
  chain.normals_right = -chain.normals_right;
}

LinkedChains link_arcs(const Section& section, const std::vector<SectionArc>& arcs, double tolerance) {
  LinkedChains result;
  const Ends ends{section, arcs};
  const auto end_count = static_cast<std::uint32_t>(2 * arcs.size());

  // Places where ends meet, and the ends at each as a list.
  PointIndex places(tolerance);
  std::vector<std::uint32_t> first_end;
  std::vector<std::uint32_t> next_end(end_count, kNone);
  std::vector<std::uint32_t> place_of(end_count, kNone);
  for (std::uint32_t end = 0; end < end_count; ++end) {
    const Vector2& position = ends.node(end).position;
    std::uint32_t place = places.find(position, tolerance);
    if (place == kNone) {
      place = places.insert(position);
      first_end.push_back(kNone);
    }
    place_of[end] = place;
  }
  std::vector<bool> used(arcs.size(), false);
  for (std::uint32_t arc = 0; arc < arcs.size(); ++arc) {
    if (place_of[2 * arc] == place_of[2 * arc + 1] && length_of(section, arcs[arc]) <= 4.0 * tolerance) {
      used[arc] = true;
      ++result.dropped_arcs;
    }
  }
  for (std::uint32_t end = end_count; end-- > 0;) {
    if (used[end / 2]) continue;
    next_end[end] = first_end[place_of[end]];
    first_end[place_of[end]] = end;
  }

  std::vector<std::uint32_t> partner(end_count, kNone);
  for (const std::uint32_t first : first_end) {
    if (first == kNone) continue;
    const std::uint32_t second = next_end[first];
    if (second == kNone) continue;
    if (next_end[second] == kNone) {
      partner[first] = second;
      partner[second] = first;
      continue;
    }
    ++result.branchings;
    std::vector<std::uint32_t> meeting;
    for (std::uint32_t end = first; end != kNone; end = next_end[end]) meeting.push_back(end);
    pair_at_branching(ends, std::move(meeting), partner);
  }

  const auto walk = [&](std::uint32_t start) {
    NodeChain chain;
    std::uint32_t end = start;
    while (end != kNone && !used[end / 2]) {
      const std::uint32_t arc = end / 2;
      used[arc] = true;
      const bool reversed = end % 2 != 0;
      chain.normals_right += (reversed ? -1.0 : 1.0) * length_of(section, arcs[arc]);
      append(chain, section, arcs[arc], reversed);
      end = partner[end ^ 1U];
    }
    chain.closed = end != kNone;
    if (chain.closed) {
      // The last node is the first once more.
      ContourNode& first = chain.nodes.front();
      first.tangent_in = chain.nodes.back().tangent_in;
      first.corner = is_corner(first.tangent_in, first.tangent_out);
      chain.nodes.pop_back();
    }
    if (chain.normals_right < 0.0) reverse(chain);
    result.chains.push_back(std::move(chain));
  };
  for (std::uint32_t end = 0; end < end_count; ++end) {
    if (!used[end / 2] && partner[end] == kNone) walk(end);
  }
  for (std::uint32_t arc = 0; arc < arcs.size(); ++arc) {
    if (!used[arc]) walk(2 * arc);
  }
  return result;
}

}  // namespace lamina::engine
