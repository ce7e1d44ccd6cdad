#include "engine/contour/layer_chains.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "engine/contour/bridge_gaps.h"
#include "engine/contour/in_plane.h"
#include "engine/contour/link_arcs.h"
#include "engine/contour/node_chain.h"
#include "engine/contour/unite_chains.h"
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

/// Width of a strip with the outline's area and length, mm.
double mean_width(const NodeChain& outline) {
  const Loop loop = loop_of(outline);
  return 2.0 * std::abs(signed_area(loop)) / perimeter(loop);
}

bool near_any(const Vector2& place, const std::vector<NodeChain>& chains, double distance) {
  return std::any_of(chains.begin(), chains.end(),
                     [&](const NodeChain& chain) { return distance_to_chain(place, chain) <= distance; });
}

/// Whether a touch curve is a part of the contours: where the plane passes through a saddle, say.
bool runs_along(const NodeChain& touch, const std::vector<NodeChain>& chains, double distance) {
  return std::all_of(touch.nodes.begin(), touch.nodes.end(),
                     [&](const ContourNode& node) { return near_any(node.position, chains, distance); });
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
  report.tiles = finder.tile_count();
  report.shared_cells = meetings.shared_cells;
  report.close_places = meetings.close_places;
  report.meetings = meetings.chains.size();
  if (options.unite_all) {
    for (std::uint32_t c = 0; c < chains.size(); ++c) meetings.chains.emplace_back(c, c);
  }
  std::vector<bool> united(chains.size(), false);
  std::vector<NodeChain> closed;
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
      if (mean_width(outline) < options.chord_part * options.epsilon) {
        ++report.dropped_pieces;
        report.dropped_length += length_of(outline);
      } else {
        closed.push_back(std::move(outline));
      }
    }
    std::move(result.open.begin(), result.open.end(), std::back_inserter(open));
  }
  for (std::size_t c = 0; c < chains.size(); ++c) {
    if (!united[c]) (chains[c].closed ? closed : open).push_back(std::move(chains[c]));
  }
  return closed;
}

}  // namespace

LayerChains make_chains(const Section& section, const SliceOptions& options, MeetingFinder& meetings,
                        LayerReport& report) {
  const double joined = joined_distance(options);
  InPlane in_plane = sort_out_in_plane(
      section, {options.epsilon, joined, joined + kCoincidentChords * options.chord_part * options.epsilon});
  LinkedChains linked = link_arcs(section, in_plane.section_arcs, joined);
  report.branchings = linked.branchings;
  std::vector<NodeChain> chains =
      bridge_gaps(std::move(linked.chains), {options.epsilon, joined, options.longest_bridge}, report);

  LayerChains layer;
  layer.closed = united_chains(std::move(chains), options, meetings, layer.open, report);
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
