#include "engine/contour/layer_chains.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

#include "engine/contour/bridge_gaps.h"
#include "engine/contour/in_plane.h"
#include "engine/contour/link_arcs.h"
#include "engine/contour/node_chain.h"
#include "engine/contour/unite_chains.h"
#include "engine/contour/unite_solids.h"
#include "engine/geometry/polygon.h"
#include "engine/model.h"

namespace lamina::engine {
namespace {

/// Ends of arcs this near, as a part of epsilon, are one point; at least twice the model tolerance.
constexpr double kJoined = 1e-3;
/// Chords of one edge that two patches share may differ by twice the chord tolerance.
constexpr double kCoincidentChords = 3.0;
/// Chains that come this near touch: twice the model tolerance.
constexpr double kTouching = 2.0 * kModelTolerance;
/// Dead ends shorter than this many epsilon are overshoot, not open contours.
constexpr double kShortestOpen = 4.0;

double joined_distance(const SliceOptions& options) {
  return std::max(2.0 * kModelTolerance, kJoined * options.epsilon);
}

/// Chains in groups that meet, in order of their first chain.
std::vector<std::vector<std::uint32_t>> groups_of(std::size_t count, const Meetings& meetings) {
  std::vector<std::uint32_t> root(count);
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](std::uint32_t c) {
    while (root[c] != c) c = root[c] = root[root[c]];
    return c;
  };
  std::vector<bool> meets(count, false);
  for (const auto& [a, b] : meetings.chains) {
    meets[a] = meets[b] = true;
    const std::uint32_t low = std::min(find(a), find(b));
    const std::uint32_t high = std::max(find(a), find(b));
    root[high] = low;
  }
  std::vector<std::vector<std::uint32_t>> groups(count);
  for (std::uint32_t c = 0; c < count; ++c) {
    if (meets[c]) groups[find(c)].push_back(c);
  }
  std::erase_if(groups, [](const auto& group) { return group.empty(); });
  return groups;
}

bool near_any(const Vector2& place, const std::vector<NodeChain>& chains, double distance) {
  return std::any_of(chains.begin(), chains.end(),
                     [&](const NodeChain& chain) { return distance_to_chain(place, chain) <= distance; });
}

/// Whether a chain is a part of the contours: a touch curve where the plane passes through a saddle, say.
bool runs_along(const NodeChain& chain, const std::vector<NodeChain>& chains, double distance) {
  const std::size_t segments = chain.nodes.size() - (chain.closed ? 0 : 1);
  for (std::size_t k = 0; k < segments; ++k) {
    const Vector2& from = chain.nodes[k].position;
    const Vector2& to = chain.nodes[(k + 1) % chain.nodes.size()].position;
    // A straight one may have nothing but its two ends there.
    for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      if (!near_any(from + part * (to - from), chains, distance)) return false;
    }
  }
  return true;
}

/// Touch points that are no part of anything else, each place once.
std::vector<Vector2> lone_points(const std::vector<Vector2>& candidates, const LayerChains& layer,
                                 double epsilon) {
  std::vector<Vector2> points;
  for (const Vector2& place : candidates) {
    bool covered = near_any(place, layer.closed, epsilon) || near_any(place, layer.open, epsilon) ||
                   near_any(place, layer.touch_curves, epsilon);
    for (const LayerChains::Face& face : layer.faces) {
      covered =
          covered || distance_to_chain(place, face.outer) <= epsilon || near_any(place, face.inner, epsilon);
    }
    for (const Vector2& point : points) covered = covered || (point - place).norm() <= epsilon;
    if (!covered) points.push_back(place);
  }
  return points;
}

/// The chains with those united that meet; what is left open goes to `open`.
std::vector<NodeChain> united_chains(std::vector<NodeChain> chains, const SliceOptions& options,
                                     MeetingFinder& finder, std::vector<NodeChain>& open,
                                     LayerReport& report) {
  Meetings meetings = finder.find(chains, kTouching);
  report.tiles += finder.tile_count();
  report.shared_cells += meetings.shared_cells;
  report.close_places += meetings.close_places;
  report.meetings += meetings.chains.size();
  if (options.unite_all) {
    for (std::uint32_t c = 0; c < chains.size(); ++c) meetings.chains.emplace_back(c, c);
  }
  std::vector<bool> united(chains.size(), false);
  std::vector<NodeChain> closed;
  std::vector<NodeChain> slivers;
  for (const std::vector<std::uint32_t>& group : groups_of(chains.size(), meetings)) {
    std::vector<NodeChain> members;
    for (const std::uint32_t c : group) {
      united[c] = true;
      members.push_back(std::move(chains[c]));
    }
    report.resolved_contours += members.size();
    UnitedChains result = unite_chains(members, kShortestOpen * options.epsilon);
    report.dropped_pieces += result.dropped_pieces;
    report.dropped_length += result.dropped_length;
    for (NodeChain& outline : result.outlines) {
      (mean_width(outline) < options.chord_part * options.epsilon ? slivers : closed)
          .push_back(std::move(outline));
    }
    std::move(result.open.begin(), result.open.end(), std::back_inserter(open));
  }
  for (std::size_t c = 0; c < chains.size(); ++c) {
    if (!united[c]) (chains[c].closed ? closed : open).push_back(std::move(chains[c]));
  }
  // What is thinner than the chords are exact is no region; but where it leads away from all others, as the
  // tip of a needle does whose sides cross as chords, it is part of the section.
  std::vector<NodeChain> kept;
  for (NodeChain& sliver : slivers) {
    if (runs_along(sliver, closed, options.epsilon)) {
      ++report.dropped_pieces;
      report.dropped_length += length_of(sliver);
    } else {
      kept.push_back(std::move(sliver));
    }
  }
  std::move(kept.begin(), kept.end(), std::back_inserter(closed));
  return closed;
}

template <typename T>
void append(std::vector<T>& list, const std::vector<T>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

/// The arcs of the known solids, linked, and the rest.
struct SortedArcs {
  std::vector<std::vector<NodeChain>> solids;  ///< closed chains of each
  std::vector<SectionArc> rest;                ///< of no known solid, or of one that does not close
};

/// A solid whose gaps are below epsilon stands by itself.
SortedArcs sort_by_solid(const Section& section, std::vector<SectionArc> arcs, const SolidNumbers& solids,
                         BridgeOptions options, LayerReport& report) {
  SortedArcs sorted;
  if (solids.none()) {
    sorted.rest = std::move(arcs);
    return sorted;
  }
  std::map<std::uint32_t, std::vector<SectionArc>> by_solid;
  for (const SectionArc& arc : arcs) by_solid[solids.of(arc)].push_back(arc);
  options.longest_bridge = options.epsilon;
  for (const auto& [solid, its_arcs] : by_solid) {
    if (solid != 0) {
      LinkedChains linked = link_arcs(section, its_arcs, options.joined);
      BridgedChains bridged = bridge_gaps(std::move(linked.chains), options);
      if (std::all_of(bridged.chains.begin(), bridged.chains.end(),
                      [](const NodeChain& chain) { return chain.closed; })) {
        report.branchings += linked.branchings;
        append(report.bridged_gaps, bridged.bridges);
        sorted.solids.push_back(std::move(bridged.chains));
        continue;
      }
    }
    append(sorted.rest, its_arcs);
  }
  return sorted;
}

}  // namespace

LayerChains make_chains(const Section& section, const SolidNumbers& solids, const SliceOptions& options,
                        MeetingFinder& meetings, LayerReport& report) {
  const double joined = joined_distance(options);
  InPlane in_plane = sort_out_in_plane(
      section, {options.epsilon, joined, joined + kCoincidentChords * options.chord_part * options.epsilon});
  const BridgeOptions bridges{options.epsilon, joined, options.longest_bridge};
  SortedArcs sorted = sort_by_solid(section, std::move(in_plane.section_arcs), solids, bridges, report);
  LinkedChains linked = link_arcs(section, sorted.rest, joined);
  report.branchings += linked.branchings;
  BridgedChains bridged = bridge_gaps(std::move(linked.chains), bridges);
  append(report.bridged_gaps, bridged.bridges);
  append(report.open_gaps, bridged.open_gaps);

  LayerChains layer;
  layer.closed = united_chains(std::move(bridged.chains), options, meetings, layer.open, report);
  if (!sorted.solids.empty()) {
    std::vector<std::vector<NodeChain>> outlines{std::move(layer.closed)};
    for (std::vector<NodeChain>& solid : sorted.solids)
      outlines.push_back(united_chains(std::move(solid), options, meetings, layer.open, report));
    layer.closed =
        unite_solids(std::move(outlines), kCoincidentChords * options.chord_part * options.epsilon);
  }
  // Crumbs of a surface that ends within the model tolerance of the plane: a touch, if anything.
  std::erase_if(layer.open, [&](const NodeChain& chain) {
    if (length_of(chain) > options.epsilon) return false;
    in_plane.touch_points.push_back(chain.nodes[chain.nodes.size() / 2].position);
    return true;
  });
  for (NodeChain& touch : in_plane.touch_curves) {
    if (length_of(touch) <= options.epsilon) {
      in_plane.touch_points.push_back(touch.nodes[touch.nodes.size() / 2].position);
    } else if (runs_along(touch, layer.closed, options.epsilon) ||
               runs_along(touch, layer.open, options.epsilon)) {
      ++report.contained_touches;
    } else {
      layer.touch_curves.push_back(std::move(touch));
    }
  }
  for (FaceOutline& face : in_plane.faces)
    layer.faces.push_back({std::move(face.outer), std::move(face.inner)});
  layer.touch_points = lone_points(in_plane.touch_points, layer, options.epsilon);
  report.contained_touches += in_plane.touch_points.size() - layer.touch_points.size();
  report.components = layer.closed.size() + layer.open.size() + layer.touch_curves.size() +
                      layer.faces.size() + layer.touch_points.size();
  return layer;
}

}  // namespace lamina::engine
