#include "engine/sparse/sparse_slicer.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "engine/geometry/polygon.h"
#include "engine/grid/layer_grid.h"
#include "engine/slicer.h"
#include "engine/sparse/bridge_gaps.h"
#include "engine/sparse/in_plane.h"
#include "engine/sparse/link_arcs.h"
#include "engine/sparse/unite_chains.h"

namespace lamina::engine {
namespace {

/// Sub-patches are not divided below this part of epsilon.
constexpr double kSmallestCell = 0.1;
/// Ends of arcs this near, as a part of epsilon, are one point; at least twice the model tolerance.
constexpr double kJoined = 1e-3;
/// Chords of one edge that two patches share may differ by twice the chord tolerance.
constexpr double kCoincidentChords = 3.0;
/// Chains that come this near touch: twice the model tolerance.
constexpr double kTouching = 2.0 * kModelTolerance;
/// Dead ends shorter than this many epsilon are overshoot, not open contours.
constexpr double kShortestOpen = 4.0;

std::vector<SlicePlane> checked(std::vector<SlicePlane> planes, const SliceOptions& options) {
  if (!(options.epsilon > 2.0 * kModelTolerance)) {
    throw SliceError(fmt::format("tolerance is {} mm: it must be above {} mm, twice the model tolerance",
                                 options.epsilon, 2.0 * kModelTolerance));
  }
  for (std::size_t k = 1; k < planes.size(); ++k) {
    if (!(planes[k].z >= planes[k - 1].z)) {
      throw SliceError(fmt::format("plane {} at z = {} mm lies below the plane before it (z = {} mm)", k,
                                   planes[k].z, planes[k - 1].z));
    }
  }
  return planes;
}

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

double chain_length(const NodeChain& chain) {
  double length = 0.0;
  const std::size_t count = chain.nodes.size() - (chain.closed ? 0 : 1);
  for (std::size_t s = 0; s < count; ++s) {
    length +=
        (chain.nodes[s + 1 == chain.nodes.size() ? 0 : s + 1].position - chain.nodes[s].position).norm();
  }
  return length;
}

/// Width of a strip with the outline's area and length, mm.
double mean_width(const NodeChain& outline) {
  Loop loop;
  loop.reserve(outline.nodes.size());
  for (const ContourNode& node : outline.nodes) loop.push_back(node.position);
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

}  // namespace

PlanarCurve polyline_through(const NodeChain& chain) {
  Polyline points;
  points.reserve(chain.nodes.size() + 1);
  for (const ContourNode& node : chain.nodes) points.push_back(node.position);
  if (chain.closed) points.push_back(points.front());
  return polyline_curve(points);
}

SparseSlicer::SparseSlicer(const Model& model, std::vector<SlicePlane> planes, const SliceOptions& options,
                           SparseOptions sparse)
    : options_(options),
      sparse_(std::move(sparse)),
      planes_(checked(std::move(planes), options)),
      front_(model),
      patch_section_({sparse_.chord_part * options.epsilon, kSmallestCell * options.epsilon}),
      meetings_(options.epsilon) {}

std::vector<NodeChain> SparseSlicer::united(std::vector<NodeChain> chains, std::vector<NodeChain>& open) {
  Meetings meetings = meetings_.find(chains, kTouching);
  report_.tiles = meetings_.tile_count();
  report_.shared_cells = meetings.shared_cells;
  report_.close_places = meetings.close_places;
  report_.meetings = meetings.chains.size();
  if (sparse_.unite_all) {
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
    report_.resolved_contours += members.size();
    UnitedChains result = unite_chains(members, kShortestOpen * options_.epsilon);
    report_.dropped_pieces += result.dropped_pieces;
    report_.dropped_length += result.dropped_length;
    for (NodeChain& outline : result.outlines) {
      if (mean_width(outline) < sparse_.chord_part * options_.epsilon) {
        ++report_.dropped_pieces;
        report_.dropped_length += chain_length(outline);
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

std::optional<LayerChains> SparseSlicer::next_chains() {
  if (next_plane_ == planes_.size()) return std::nullopt;
  const double z = planes_[next_plane_++].z;
  report_ = {};
  front_.advance(z, kModelTolerance);
  section_.clear();
  for (const FrontPatch& patch : front_.active()) patch_section_.cut(patch, z, section_);
  report_.active_patches = front_.active().size();
  report_.patches_added = front_.added();
  report_.patches_removed = front_.removed();
  report_.cells = section_.cells;
  report_.unresolved_cells = section_.unresolved_cells;
  report_.arcs = section_.arcs.size();
  report_.nodes = section_.nodes.size();

  const double joined = joined_distance(options_);
  InPlane in_plane = sort_out_in_plane(
      section_,
      {options_.epsilon, joined, joined + kCoincidentChords * sparse_.chord_part * options_.epsilon});
  LinkedChains linked = link_arcs(section_, in_plane.section_arcs, joined);
  report_.branchings = linked.branchings;
  std::vector<NodeChain> chains =
      bridge_gaps(std::move(linked.chains), {options_.epsilon, joined, sparse_.longest_bridge}, report_);

  LayerChains layer;
  layer.closed = united(std::move(chains), layer.open);
  // Crumbs of a surface that ends within the model tolerance of the plane: a touch, if anything.
  std::erase_if(layer.open, [&](const NodeChain& chain) {
    if (chain_length(chain) > options_.epsilon) return false;
    in_plane.touch_points.push_back(chain.nodes[chain.nodes.size() / 2].position);
    return true;
  });
  for (NodeChain& touch : in_plane.touch_curves) {
    if (chain_length(touch) <= options_.epsilon) {
      in_plane.touch_points.push_back(touch.nodes[touch.nodes.size() / 2].position);
    } else if (runs_along(touch, layer.closed, options_.epsilon) ||
               runs_along(touch, layer.open, options_.epsilon)) {
      ++report_.contained_touches;
    } else {
      layer.touch_curves.push_back(std::move(touch));
    }
  }
  for (FaceOutline& face : in_plane.faces)
    layer.faces.push_back({std::move(face.outer), std::move(face.inner)});
  layer.touch_points = lone_points(in_plane.touch_points, layer, options_.epsilon);
  report_.contained_touches += in_plane.touch_points.size() - layer.touch_points.size();
  report_.components = layer.closed.size() + layer.open.size() + layer.touch_curves.size() +
                       layer.faces.size() + layer.touch_points.size();
  return layer;
}

std::optional<Layer> SparseSlicer::next() {
  const std::size_t index = next_plane_;
  const std::optional<LayerChains> chains = next_chains();
  if (!chains) return std::nullopt;
  Layer layer;
  layer.index = index;
  layer.plane = planes_[index];
  std::size_t control_points = 0;
  const auto curve = [&](const NodeChain& chain) {
    PlanarCurve made = sparse_.make_curve(chain);
    control_points += made.control_points.size();
    return made;
  };
  for (const NodeChain& chain : chains->closed) layer.closed.push_back({curve(chain), false});
  for (const NodeChain& chain : chains->open) layer.open.push_back({curve(chain), false});
  for (const NodeChain& chain : chains->touch_curves) {
    if (chain.closed) {
      layer.closed.push_back({curve(chain), true});
    } else {
      layer.open.push_back({curve(chain), true});
    }
  }
  for (const LayerChains::Face& face : chains->faces) {
    PlanarContour planar{curve(face.outer), {}};
    for (const NodeChain& hole : face.inner) planar.inner.push_back(curve(hole));
    layer.planar.push_back(std::move(planar));
  }
  for (const Vector2& point : chains->touch_points) layer.points.push_back({point});

  report_.control_points = control_points;
  layer.report.active_patches = report_.active_patches;
  layer.report.patches_added = report_.patches_added;
  layer.report.patches_removed = report_.patches_removed;
  layer.report.points_near_plane = report_.nodes;
  layer.report.points_held = report_.nodes;
  layer.report.grid_cells = report_.tiles * 64 * 64;
  layer.report.boundary_cells = report_.shared_cells;
  layer.report.components = report_.components;
  layer.report.control_points = control_points;
  layer.report.dropped_spurs = report_.dropped_pieces;
  return layer;
}

}  // namespace lamina::engine
