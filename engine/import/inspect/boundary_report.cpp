#include "engine/import/inspect/boundary_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "engine/import/inspect/edge_chords.h"
#include "engine/import/inspect/trimmed_area.h"

namespace lamina::engine {
namespace {

constexpr double kJoinedPart = 1e-3;  ///< of the model's diagonal

/// Two surfaces that meet along an edge, and whether their normals agree there.
struct Joint {
  std::size_t first = 0;
  std::size_t second = 0;
  bool agree = true;
};

/// How often an edge was found along another one, run against it or with it.
struct Votes {
  std::size_t agree = 0;
  std::size_t differ = 0;

  std::size_t count() const { return agree + differ; }
};
using EdgePartners = std::map<std::size_t, Votes>;

/// A set of faces that hang together.
struct Shell {
  double volume = 0.0;
  Box3 box;
};

/// Turns the faces of each shell alike; its volume is then the sum of their flux. Nothing where faces cannot
/// be turned so that all neighbours agree.
std::optional<std::vector<Shell>> shells(const Model& model, const std::vector<Joint>& joints,
                                         const std::vector<SurfaceIntegrals>& integrals) {
  std::vector<std::vector<std::pair<std::size_t, bool>>> neighbours(model.surfaces.size());
  for (const Joint& joint : joints) {
    neighbours[joint.first].emplace_back(joint.second, joint.agree);
    neighbours[joint.second].emplace_back(joint.first, joint.agree);
  }
  std::vector<int> turned(model.surfaces.size(), 0);
  std::vector<Shell> list;
  for (std::size_t seed = 0; seed < turned.size(); ++seed) {
    if (turned[seed] != 0) continue;
    turned[seed] = 1;
    std::vector<std::size_t> open{seed};
    Shell shell;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      shell.volume += turned[at] * integrals[at].flux;
      shell.box.extend(control_box(model.surfaces[at].nurbs.net));
      for (const auto& [next, agree] : neighbours[at]) {
        const int wanted = agree ? turned[at] : -turned[at];
        if (turned[next] != 0 && turned[next] != wanted) return std::nullopt;
        if (turned[next] != 0) continue;
        turned[next] = wanted;
        open.push_back(next);
      }
    }
    shell.volume = std::abs(shell.volume);
    list.push_back(shell);
  }
  return list;
}

double volume_of(const std::vector<Shell>& list) {
  double volume = 0.0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    std::size_t around = 0;
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (k != i && list[k].box.contains(list[i].box) && list[k].volume > list[i].volume) ++around;
    }
    volume += around % 2 == 0 ? list[i].volume : -list[i].volume;
  }
  return volume;
}

/// Of the faces of one solid; their volume, nothing where it is unclear.
std::optional<double> add_surfaces(const Model& model, BoundaryReport& report) {
  const std::size_t open_before = report.open_edges;
  const std::vector<FaceEdge> edges = face_edges(model);
  const EdgeChords chords(model, edges, report.joined_within);
  report.edges += edges.size();
  std::vector<EdgePartners> partners(edges.size());
  std::vector<std::size_t> points(edges.size(), 0);
  std::vector<std::size_t> crowded(edges.size(), 0);  // points where more than one other edge lies
  std::vector<bool> is_open(edges.size(), false);
  for (const EdgeChords::Chord& chord : chords.chords()) {
    const Vector3 point = edge_point(model, edges[chord.edge], 0.5 * (chord.first + chord.last));
    const auto found = chords.nearest(point, chord.edge);
    if (!found) {
      if (is_open[chord.edge]) continue;
      is_open[chord.edge] = true;
      if (report.open_edges++ == 0) report.open_at = point;
      continue;
    }
    if (found->distance > report.largest_gap) {
      report.largest_gap = found->distance;
      report.largest_gap_at = point;
    }
    ++points[chord.edge];
    if (found->alike > 1) ++crowded[chord.edge];
    auto& votes = partners[chord.edge][found->edge];
    // Faces on the left of edges that run against each other have normals that agree.
    ++((chord.end - chord.start).dot(found->direction) < 0.0 ? votes.agree : votes.differ);
  }
  std::vector<Joint> joints;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto partner =
        std::max_element(partners[i].begin(), partners[i].end(),
                         [](const auto& a, const auto& b) { return a.second.count() < b.second.count(); });
    if (partner == partners[i].end()) continue;
    joints.push_back(
        {edges[i].surface, edges[partner->first].surface, partner->second.agree >= partner->second.differ});
  }
  std::vector<SurfaceIntegrals> integrals;
  for (const Surface& surface : model.surfaces) {
    integrals.push_back(surface_integrals(surface));
    report.area += integrals.back().area;
  }
  if (report.open_edges > open_before) return std::nullopt;
  // At single points other edges end; along an edge more than one other means more than two faces.
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (2 * crowded[i] > points[i]) return std::nullopt;
  }
  const auto list = shells(model, joints, integrals);
  return list ? std::optional(volume_of(*list)) : std::nullopt;
}

void add_mesh(const TriangleMesh& mesh, BoundaryReport& report) {
  std::vector<std::array<std::uint32_t, 2>> sides;
  double six_volumes = 0.0;
  for (const auto& facet : mesh.facets) {
    const Vector3 a = mesh.vertices[facet[0]].cast<double>();
    const Vector3 b = mesh.vertices[facet[1]].cast<double>();
    const Vector3 c = mesh.vertices[facet[2]].cast<double>();
    report.area += 0.5 * (b - a).cross(c - a).norm();
    six_volumes += a.dot(b.cross(c));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = facet[k];
      const std::uint32_t to = facet[(k + 1) % 3];
      if (from != to) sides.push_back({std::min(from, to), std::max(from, to)});
    }
  }
  std::sort(sides.begin(), sides.end());
  bool closed = true;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t next = i;
    while (next < sides.size() && sides[next] == sides[i]) ++next;
    ++report.edges;
    if ((next - i) % 2 != 0) {
      if (report.open_edges++ == 0) report.open_at = mesh.vertices[sides[i][0]].cast<double>();
      closed = false;
    }
    i = next;
  }
  if (closed && report.volume) *report.volume += std::abs(six_volumes) / 6.0;
}

}  // namespace

BoundaryReport boundary_report(const Model& model) {
  BoundaryReport report;
  report.joined_within = kJoinedPart * control_box(model).diagonal().norm();
  report.volume = 0.0;
  std::map<std::uint32_t, Model> solids;
  for (const Surface& surface : model.surfaces) solids[surface.solid].surfaces.push_back(surface);
  for (const auto& [number, solid] : solids) {
    const auto volume = report.joined_within > 0.0 ? add_surfaces(solid, report) : std::nullopt;
    report.volume = report.volume && volume ? std::optional(*report.volume + *volume) : std::nullopt;
  }
  for (const TriangleMesh& mesh : model.meshes) add_mesh(mesh, report);
  if (!report.is_closed()) report.volume.reset();
  return report;
}

}  // namespace lamina::engine
