#include "engine/pointcloud/trim_section.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace lamina::engine {
namespace {

constexpr int kMostRootSteps = 80;
/// Height over the plane at which an arc ends on its trim curve, mm.
constexpr double kInPlane = 1e-12;
/// Off the middle, where symmetric parts are touched by round holes.
constexpr double kProbe = 0.4142;
/// How near to a trim curve an arc runs along it, in parts of the domain.
constexpr double kAlong = 1e-6;

/// The section's direction where a surface has these derivatives, the outward normal on its right; zero where
/// it has none.
Vector2 section_tangent(const SurfaceDerivatives& d) {
  const Vector2 tangent = d.du.head<2>() * d.dv.z() - d.dv.head<2>() * d.du.z();
  const double length = tangent.norm();
  return length > 1e-9 * d.du.norm() * d.dv.norm() ? Vector2(tangent / length) : Vector2(Vector2::Zero());
}

/// Parameter at which the lifted trim curve passes the plane between two of its samples; nothing where it
/// does not. Bisection with secant steps (Illinois; Dowell and Jarratt, 1971).
std::optional<double> find_root(const TrimRegion& region, std::uint32_t edge, const EdgeSample& first,
                                const EdgeSample& last, double z) {
  double low = first.t;
  double high = last.t;
  double f_low = first.position.z() - z;
  double f_high = last.position.z() - z;
  if (f_low == 0.0 || f_high == 0.0) return f_low == 0.0 ? low : high;
  if ((f_low > 0.0) == (f_high > 0.0)) return std::nullopt;
  double root = low;
  bool moved_high = false;
  for (int step = 0; step < kMostRootSteps; ++step) {
    root = (low * f_high - high * f_low) / (f_high - f_low);
    if (!(root > low && root < high)) root = 0.5 * (low + high);
    const double f = region.on_surface(region.on_edge(edge, root)).z() - z;
    if (std::abs(f) < kInPlane || high - low <= 1e-15 * (std::abs(low) + std::abs(high))) break;
    const bool moves_high = (f > 0.0) == (f_high > 0.0);
    // An end that stays twice counts half.
    if (step > 0 && moves_high == moved_high) (moves_high ? f_low : f_high) *= 0.5;
    (moves_high ? high : low) = root;
    (moves_high ? f_high : f_low) = f;
    moved_high = moves_high;
  }
  return root;
}

class ArcTrimmer {
 public:
  ArcTrimmer(Section& section, const FrontPatch& patch, double z)
      : section_(section),
        patch_(patch),
        region_(*patch.trim()),
        z_(z),
        level_edges_(region_.edges_in_plane(z)) {}

  void trim(const SectionArc& arc, const std::vector<SectionNode>& nodes) {
    std::vector<Vector2> line;
    line.reserve(nodes.size());
    for (const SectionNode& node : nodes) line.push_back(global(node.parameters));
    std::vector<Cut> cuts;
    for (const TrimCrossing& crossing : region_.crossings(line))
      cuts.push_back({crossing.side, crossing, nullptr});
    if (!level_edges_.empty()) add_ends_of_level_edges(nodes, cuts);
    Cut from;
    bool at_start = true;
    for (std::size_t c = 0; c <= cuts.size(); ++c) {
      const bool at_end = c == cuts.size();
      const Cut to = at_end ? Cut{nodes.size() - 1, {}, nullptr} : cuts[c];
      const Vector2 probe = probe_of(nodes, from, to);
      // What runs along a trim curve is that curve's own edge.
      if (region_.contains(probe) && !on_level_edge(probe)) emit(arc, nodes, from, at_start, to, at_end);
      from = to;
      at_start = false;
    }
  }

 private:
  /// A place on the arc: on the chord after node k.
  struct Cut {
    std::size_t k = 0;
    TrimCrossing crossing;
    const EdgeSample* end = nullptr;  ///< where it is the end of a trim curve

    double place() const { return static_cast<double>(k) + crossing.along; }
  };

  Vector2 global(const Vector2& local) const {
    return patch_.low() + local.cwiseProduct(patch_.high() - patch_.low());
  }

  Vector2 parameters_at(const std::vector<SectionNode>& nodes, double place) const {
    const auto k = std::min(static_cast<std::size_t>(place), nodes.size() - 2);
    const double s = place - static_cast<double>(k);
    return global((1.0 - s) * nodes[k].parameters + s * nodes[k + 1].parameters);
  }

  /// Distance of a place from a chord, in parts of the domain, and where on the chord.
  std::pair<double, double> distance_to(const Vector2& place, const Vector2& a, const Vector2& b) const {
    const NurbsSurface& surface = region_.surface();
    const Vector2 unit(1.0 / (surface.last_u() - surface.first_u()),
                       1.0 / (surface.last_v() - surface.first_v()));
    const Vector2 along = (b - a).cwiseProduct(unit);
    const Vector2 to = (place - a).cwiseProduct(unit);
    const double s = std::clamp(to.dot(along) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
    return {(to - s * along).norm(), s};
  }

  /// An arc that runs along a trim curve meets the loop where that curve ends, perhaps without crossing it.
  void add_ends_of_level_edges(const std::vector<SectionNode>& nodes, std::vector<Cut>& cuts) const {
    for (const std::uint32_t edge : level_edges_) {
      const std::vector<EdgeSample>& samples = region_.samples()[edge];
      for (const EdgeSample* end : {&samples.front(), &samples.back()}) {
        for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
          const auto [distance, along] =
              distance_to(end->parameters, global(nodes[k].parameters), global(nodes[k + 1].parameters));
          if (distance <= kAlong) cuts.push_back({k, {k, along, edge, 0}, end});
        }
      }
    }
    std::stable_sort(cuts.begin(), cuts.end(),
                     [](const Cut& a, const Cut& b) { return a.place() < b.place(); });
  }

  bool on_level_edge(const Vector2& place) const {
    for (const std::uint32_t edge : level_edges_) {
      const std::vector<EdgeSample>& samples = region_.samples()[edge];
      for (std::size_t k = 1; k < samples.size(); ++k) {
        if (distance_to(place, samples[k - 1].parameters, samples[k].parameters).first <= kAlong) return true;
      }
    }
    return false;
  }

  /// Between two cuts, where it is told on which side of the trim curves they are.
  Vector2 probe_of(const std::vector<SectionNode>& nodes, const Cut& from, const Cut& to) const {
    return parameters_at(nodes, from.place() + kProbe * (to.place() - from.place()));
  }

  /// The node where the arc meets the trim curve.
  SectionNode node_at(const std::vector<SectionNode>& nodes, const Cut& cut) const {
    const double s = cut.crossing.along;
    const SectionNode& a = nodes[cut.k];
    const SectionNode& b = nodes[std::min(cut.k + 1, nodes.size() - 1)];
    SectionNode node;
    node.position = (1.0 - s) * a.position + s * b.position;
    node.tangent = s < 0.5 ? a.tangent : b.tangent;
    if (cut.crossing.edge >= region_.edges().size()) return node;
    const std::uint32_t edge = cut.crossing.edge;
    const EdgeSample* sample = &region_.samples()[edge][cut.crossing.sample];
    const std::optional<double> t =
        cut.end != nullptr ? cut.end->t : find_root(region_, edge, sample[0], sample[1], z_);
    if (t) {
      const Vector2 parameters = region_.on_edge(edge, *t);
      const SurfaceDerivatives d = evaluate_derivatives(region_.surface(), parameters.x(), parameters.y());
      const Vector2 exact = d.point.head<2>();
      if ((exact - node.position).norm() <= (b.position - a.position).norm()) {
        node.position = exact;
        const Vector2 tangent = section_tangent(d);
        // Arcs of edges in the plane may run against it.
        node.tangent = tangent.dot(node.tangent) < 0.0 ? Vector2(-tangent) : tangent;
      }
    }
    return node;
  }

  void emit(const SectionArc& arc, const std::vector<SectionNode>& nodes, const Cut& from, bool at_start,
            const Cut& to, bool at_end) {
    SectionArc piece = arc;
    piece.first = static_cast<std::uint32_t>(section_.nodes.size());
    const auto add = [&](const SectionNode& node) {
      const bool repeated =
          section_.nodes.size() > piece.first && section_.nodes.back().position == node.position;
      if (!repeated) section_.nodes.push_back(node);
    };
    add(at_start ? nodes.front() : node_at(nodes, from));
    for (std::size_t k = at_start ? 1 : from.k + 1;
         k < nodes.size() && (at_end ? k + 1 < nodes.size() : k <= to.k); ++k)
      add(nodes[k]);
    add(at_end ? nodes.back() : node_at(nodes, to));
    piece.count = static_cast<std::uint32_t>(section_.nodes.size()) - piece.first;
    if (piece.count < 2) {
      section_.nodes.resize(piece.first);
      return;
    }
    section_.arcs.push_back(piece);
  }

  Section& section_;
  const FrontPatch& patch_;
  const TrimRegion& region_;
  double z_;
  std::vector<std::uint32_t> level_edges_;  // those that lie in the plane
};

/// Whether all of an arc lies on one side of the surface's domain.
bool on_border(const std::vector<SectionNode>& nodes, const FrontPatch& patch) {
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

}  // namespace

SectionMark mark_of(const Section& section) {
  return {section.nodes.size(), section.arcs.size(), section.flat_rims.size(), section.flats.size(),
          section.touches.size()};
}

void trim_section(Section& section, const SectionMark& mark, const FrontPatch& patch, double z) {
  const auto since = [](auto& all, std::size_t first) {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    std::remove_reference_t<decltype(all)> taken(begin, all.end());
    all.erase(begin, all.end());
    return taken;
  };
  // Level pieces inside a surface that is not level itself have their rims as edges of the patches beside.
  section.flats.resize(mark.flats);
  section.flat_rims.resize(mark.flat_rims);
  const std::vector<SectionArc> arcs = since(section.arcs, mark.arcs);
  const std::vector<SectionNode> nodes = since(section.nodes, mark.nodes);
  section.touches.resize(mark.touches);
  ArcTrimmer trimmer(section, patch, z);
  for (const SectionArc& arc : arcs) {
    const auto begin = nodes.begin() + static_cast<std::ptrdiff_t>(arc.first - mark.nodes);
    const std::vector<SectionNode> own(begin, begin + arc.count);
    if (arc.kind != ArcKind::kCrossing && on_border(own, patch)) continue;
    trimmer.trim(arc, own);
  }
}

}  // namespace lamina::engine
