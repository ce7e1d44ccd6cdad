#include "engine/pointcloud/trim_section.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/pointcloud/edge_crossing.h"

namespace lamina::engine {
namespace {

/// Off the middle, where symmetric parts are touched by round holes.
constexpr double kProbe = 0.4142;
/// How near to a trim curve an arc runs along it, in parts of the domain.
constexpr double kAlong = 1e-6;

/// Distance of a place from a chord, in parts of the domain, and where on the chord.
std::pair<double, double> distance_to(const NurbsSurface& surface, const Vector2& place, const Vector2& a,
                                      const Vector2& b) {
  const Vector2 unit(1.0 / (surface.last_u() - surface.first_u()),
                     1.0 / (surface.last_v() - surface.first_v()));
  const Vector2 along = (b - a).cwiseProduct(unit);
  const Vector2 to = (place - a).cwiseProduct(unit);
  const double s = std::clamp(to.dot(along) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
  return {(to - s * along).norm(), s};
}

/// Whether all of an arc lies on one side of the surface's domain.
bool on_border(std::span<const SectionNode> nodes, const FrontPatch& patch) {
  const NurbsSurface& surface = patch.trim()->surface();
  const Vector2 low(surface.first_u(), surface.first_v());
  const Vector2 high(surface.last_u(), surface.last_v());
  const auto all = [&](int axis, double local, double global, double domain) {
    return global == domain && std::all_of(nodes.begin(), nodes.end(), [&](const SectionNode& node) {
             return node.parameters[axis] == local;
           });
  };
  return all(0, 0.0, patch.low().x(), low.x()) || all(0, 1.0, patch.high().x(), high.x()) ||
         all(1, 0.0, patch.low().y(), low.y()) || all(1, 1.0, patch.high().y(), high.y());
}

/// Whether a place lies ahead of a node, seen along a direction; everything does where there is none.
bool is_ahead(const SectionNode& node, const Vector2& place, const Vector2& along) {
  return along.isZero() || (place - node.position).dot(along) > 0.0;
}

/// Moves what `all` holds from `first` on to `taken`.
template <typename T>
void take_from(std::vector<T>& all, std::size_t first, std::vector<T>& taken) {
  taken.assign(all.begin() + static_cast<std::ptrdiff_t>(first), all.end());
  all.resize(first);
}

}  // namespace

SectionMark mark_of(const Section& section) {
  return {section.nodes.size(), section.arcs.size(), section.flat_rims.size(), section.flats.size(),
          section.touches.size()};
}

void SectionTrimmer::trim(Section& section, const SectionMark& mark, const FrontPatch& patch, double z) {
  section_ = &section;
  patch_ = &patch;
  region_ = patch.trim();
  z_ = z;
  level_edges_ = region_->edges_in_plane(z);
  // Level pieces inside a surface that is not level itself have their rims as edges of the patches beside.
  section.flats.resize(mark.flats);
  section.flat_rims.resize(mark.flat_rims);
  section.touches.resize(mark.touches);
  take_from(section.arcs, mark.arcs, arcs_);
  take_from(section.nodes, mark.nodes, nodes_);
  for (const SectionArc& arc : arcs_) {
    const Nodes own(nodes_.data() + (arc.first - mark.nodes), arc.count);
    if (arc.kind == ArcKind::kCrossing || !on_border(own, patch)) trim_arc(arc, own);
  }
}

void SectionTrimmer::trim_arc(const SectionArc& arc, Nodes nodes) {
  const Vector2 low = patch_->low();
  const Vector2 size = patch_->high() - low;
  line_.clear();
  for (const SectionNode& node : nodes) line_.push_back(low + node.parameters.cwiseProduct(size));
  cuts_.clear();
  for (const TrimCrossing& crossing : region_->chords().crossings(line_))
    cuts_.push_back({crossing.side, crossing, nullptr});
  if (!level_edges_.empty()) add_ends_of_level_edges(nodes);
  Cut from;
  bool at_start = true;
  for (std::size_t c = 0; c <= cuts_.size(); ++c) {
    const bool at_end = c == cuts_.size();
    const Cut to = at_end ? Cut{nodes.size() - 1, {}, nullptr} : cuts_[c];
    const Vector2 probe = probe_of(from, to);
    // What runs along a trim curve is that curve's own edge.
    if (region_->chords().contains(probe) && !on_level_edge(probe))
      emit(arc, nodes, from, at_start, to, at_end);
    from = to;
    at_start = false;
  }
}

/// An arc that runs along a trim curve meets the loop where that curve ends, perhaps without crossing it.
void SectionTrimmer::add_ends_of_level_edges(Nodes nodes) {
  for (const std::uint32_t edge : level_edges_) {
    const std::vector<EdgeSample>& samples = region_->samples()[edge];
    for (const EdgeSample* end : {&samples.front(), &samples.back()}) {
      for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
        const auto [distance, along] =
            distance_to(region_->surface(), end->parameters, line_[k], line_[k + 1]);
        if (distance <= kAlong) cuts_.push_back({k, {k, along, edge, 0}, end});
      }
    }
  }
  std::stable_sort(cuts_.begin(), cuts_.end(),
                   [](const Cut& a, const Cut& b) { return a.place() < b.place(); });
}

bool SectionTrimmer::on_level_edge(const Vector2& place) const {
  return std::any_of(level_edges_.begin(), level_edges_.end(), [&](std::uint32_t edge) {
    const std::vector<EdgeSample>& samples = region_->samples()[edge];
    for (std::size_t k = 1; k < samples.size(); ++k) {
      if (distance_to(region_->surface(), place, samples[k - 1].parameters, samples[k].parameters).first <=
          kAlong)
        return true;
    }
    return false;
  });
}

/// Between two cuts, where it is told on which side of the trim curves they are.
Vector2 SectionTrimmer::probe_of(const Cut& from, const Cut& to) const {
  const double place = from.place() + kProbe * (to.place() - from.place());
  const auto k = std::min(static_cast<std::size_t>(place), line_.size() - 2);
  const double s = place - static_cast<double>(k);
  return (1.0 - s) * line_[k] + s * line_[k + 1];
}

/// The node where the arc meets the trim curve.
SectionNode SectionTrimmer::node_at(Nodes nodes, const Cut& cut) const {
  const double s = cut.crossing.along;
  const SectionNode& a = nodes[cut.k];
  const SectionNode& b = nodes[std::min(cut.k + 1, nodes.size() - 1)];
  SectionNode node;
  node.position = (1.0 - s) * a.position + s * b.position;
  node.tangent = s < 0.5 ? a.tangent : b.tangent;
  const std::uint32_t edge = cut.crossing.edge;
  if (edge == TrimChord::kNoEdge) return node;
  const EdgeSample* const samples = &region_->samples()[edge][cut.crossing.sample];
  const double guess = samples[0].t + cut.crossing.on_chord * (samples[1].t - samples[0].t);
  const std::optional<PatchPoint> exact =
      cut.end != nullptr ? surface_point(*patch_, cut.end->parameters)
                         : edge_crossing(*patch_, region_->edges()[edge], guess, samples[0], samples[1], z_);
  if (exact && (exact->position.head<2>() - node.position).norm() <= (b.position - a.position).norm()) {
    node.position = exact->position.head<2>();
    const Vector2 tangent = section_tangent(exact->du, exact->dv);
    // Arcs of edges in the plane may run against it.
    node.tangent = tangent.dot(node.tangent) < 0.0 ? Vector2(-tangent) : tangent;
  }
  return node;
}

void SectionTrimmer::emit(const SectionArc& arc, Nodes nodes, const Cut& from, bool at_start, const Cut& to,
                          bool at_end) {
  SectionArc piece = arc;
  piece.first = static_cast<std::uint32_t>(section_->nodes.size());
  const SectionNode start = at_start ? nodes.front() : node_at(nodes, from);
  const SectionNode end = at_end ? nodes.back() : node_at(nodes, to);
  std::size_t first = at_start ? 1 : from.k + 1;
  std::size_t last = at_end ? nodes.size() - 1 : to.k + 1;
  // An exact end may lie beyond nodes next to where the chords crossed: the arc does not turn back to them.
  while (!at_start && first < last && !is_ahead(start, nodes[first].position, start.tangent)) ++first;
  while (!at_end && first < last && !is_ahead(nodes[last - 1], end.position, end.tangent)) --last;
  const auto add = [&](const SectionNode& node) {
    const bool repeated =
        section_->nodes.size() > piece.first && section_->nodes.back().position == node.position;
    if (!repeated) section_->nodes.push_back(node);
  };
  add(start);
  for (std::size_t k = first; k < last; ++k) add(nodes[k]);
  add(end);
  piece.count = static_cast<std::uint32_t>(section_->nodes.size()) - piece.first;
  if (piece.count < 2) {
    section_->nodes.resize(piece.first);
    return;
  }
  section_->arcs.push_back(piece);
}

}  // namespace lamina::engine
