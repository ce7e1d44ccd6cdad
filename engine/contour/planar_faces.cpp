#include "engine/contour/planar_faces.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace lamina::engine {
namespace {

/// Directions by angle from the positive x axis, exactly.
bool before_by_angle(LatticePoint centre, LatticePoint p, LatticePoint q) {
  const auto lower = [&](LatticePoint r) { return r.y < centre.y || (r.y == centre.y && r.x < centre.x); };
  if (lower(p) != lower(q)) return !lower(p);
  return turn(centre, p, q) > 0;
}

void find_dangling(const PlanarGraph& graph, PlanarFaces& faces) {
  std::vector<std::vector<std::uint32_t>> edges_at(graph.vertices.size());
  std::vector<std::uint32_t> degree(graph.vertices.size(), 0);
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    for (const std::uint32_t v : {graph.edges[e].a, graph.edges[e].b}) {
      edges_at[v].push_back(e);
      ++degree[v];
    }
  }
  faces.dangling.assign(graph.edges.size(), false);
  std::vector<std::uint32_t> ends;
  for (std::uint32_t v = 0; v < degree.size(); ++v) {
    if (degree[v] == 1) ends.push_back(v);
  }
  while (!ends.empty()) {
    const std::uint32_t v = ends.back();
    ends.pop_back();
    for (const std::uint32_t e : edges_at[v]) {
      if (faces.dangling[e]) continue;
      faces.dangling[e] = true;
      const std::uint32_t other = graph.edges[e].a == v ? graph.edges[e].b : graph.edges[e].a;
      if (--degree[other] == 1) ends.push_back(other);
    }
  }
}

void sort_around_vertices(const PlanarGraph& graph, PlanarFaces& faces) {
  faces.out.assign(graph.vertices.size(), {});
  for (std::uint32_t half = 0; half < 2 * graph.edges.size(); ++half) {
    if (!faces.dangling[half / 2]) faces.out[start_of(graph, half)].push_back(half);
  }
  faces.place.assign(2 * graph.edges.size(), 0);
  for (std::uint32_t v = 0; v < faces.out.size(); ++v) {
    auto& out = faces.out[v];
    std::sort(out.begin(), out.end(), [&](std::uint32_t g, std::uint32_t h) {
      return before_by_angle(graph.vertices[v], graph.vertices[end_of(graph, g)],
                             graph.vertices[end_of(graph, h)]);
    });
    for (std::uint32_t k = 0; k < out.size(); ++k) faces.place[out[k]] = k;
  }
}

/// A closed walk with one face on its left.
struct Cycle {
  std::vector<std::uint32_t> halves;
  double area = 0.0;  ///< in lattice steps squared
  std::uint32_t component = 0;
};

std::vector<std::uint32_t> vertex_components(const PlanarGraph& graph, const PlanarFaces& faces) {
  std::vector<std::uint32_t> root(graph.vertices.size());
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](std::uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (std::uint32_t e = 0; e < graph.edges.size(); ++e) {
    if (!faces.dangling[e]) root[find(graph.edges[e].a)] = find(graph.edges[e].b);
  }
  for (std::uint32_t v = 0; v < root.size(); ++v) root[v] = find(v);
  return root;
}

std::vector<Cycle> find_cycles(const PlanarGraph& graph, const PlanarFaces& faces) {
  std::vector<Cycle> cycles;
  const std::vector<std::uint32_t> component = vertex_components(graph, faces);
  std::vector<bool> seen(2 * graph.edges.size(), false);
  for (std::uint32_t first = 0; first < seen.size(); ++first) {
    if (seen[first] || faces.dangling[first / 2]) continue;
    Cycle cycle;
    const LatticePoint origin = graph.vertices[start_of(graph, first)];
    for (std::uint32_t half = first; !seen[half];) {
      seen[half] = true;
      cycle.halves.push_back(half);
      cycle.area += static_cast<double>(
          turn(origin, graph.vertices[start_of(graph, half)], graph.vertices[end_of(graph, half)]));
      // The same face goes on along the next edge clockwise from the way back.
      const std::uint32_t back = half ^ 1U;
      const auto& out = faces.out[start_of(graph, back)];
      half = out[(faces.place[back] + out.size() - 1) % out.size()];
    }
    cycle.component = component[start_of(graph, first)];
    cycles.push_back(std::move(cycle));
  }
  return cycles;
}

bool contains(const PlanarGraph& graph, const Cycle& cycle, LatticePoint p) {
  bool inside = false;
  for (const std::uint32_t half : cycle.halves) {
    const LatticePoint a = graph.vertices[start_of(graph, half)];
    const LatticePoint b = graph.vertices[end_of(graph, half)];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    // The ray to the right crosses the edge when p lies on its left, seen upwards.
    if ((turn(a, b, p) > 0) == (b.y > a.y)) inside = !inside;
  }
  return inside;
}

}  // namespace

PlanarFaces find_faces(const PlanarGraph& graph) {
  PlanarFaces faces;
  find_dangling(graph, faces);
  sort_around_vertices(graph, faces);
  faces.face.assign(2 * graph.edges.size(), PlanarFaces::kNone);
  const std::vector<Cycle> cycles = find_cycles(graph, faces);

  // Counter-clockwise cycles are the outer rims of faces; the others are seen from the face around their
  // component.
  std::vector<std::uint32_t> face_of(cycles.size(), PlanarFaces::kNone);
  for (std::size_t c = 0; c < cycles.size(); ++c) {
    if (cycles[c].area > 0.0) face_of[c] = static_cast<std::uint32_t>(faces.face_count++);
  }
  for (std::size_t c = 0; c < cycles.size(); ++c) {
    if (cycles[c].area > 0.0) continue;
    const LatticePoint place = graph.vertices[start_of(graph, cycles[c].halves.front())];
    double smallest = std::numeric_limits<double>::infinity();
    face_of[c] = 0;
    for (std::size_t around = 0; around < cycles.size(); ++around) {
      const Cycle& rim = cycles[around];
      if (rim.area <= 0.0 || rim.component == cycles[c].component || rim.area >= smallest) continue;
      if (!contains(graph, rim, place)) continue;
      smallest = rim.area;
      face_of[c] = face_of[around];
    }
  }
  for (std::size_t c = 0; c < cycles.size(); ++c) {
    for (const std::uint32_t half : cycles[c].halves) faces.face[half] = face_of[c];
  }
  return faces;
}

}  // namespace lamina::engine
