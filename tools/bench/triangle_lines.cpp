#include "tools/bench/triangle_lines.h"

#include <algorithm>
#include <map>
#include <utility>

namespace lamina::tools {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

struct Segment {
  std::array<Edge, 2> edges;  ///< of the triangle, that its ends lie on
  bool used = false;
};

engine::Vector2 crossing(const FaceTriangles& face, const Edge& edge, double z) {
  const engine::Vector3& a = face.corners[edge.first];
  const engine::Vector3& b = face.corners[edge.second];
  const double part = (z - a.z()) / (b.z() - a.z());
  return (a + part * (b - a)).head<2>();
}

}  // namespace

std::vector<engine::Polyline> triangle_lines(const FaceTriangles& face, double z) {
  std::vector<Segment> segments;
  std::map<Edge, std::vector<std::size_t>> on_edge;
  for (const auto& triangle : face.triangles) {
    std::vector<Edge> crossed;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangle[k];
      const std::uint32_t b = triangle[(k + 1) % 3];
      if ((face.corners[a].z() < z) != (face.corners[b].z() < z)) crossed.push_back(std::minmax(a, b));
    }
    if (crossed.size() != 2) continue;
    for (const Edge& edge : crossed) on_edge[edge].push_back(segments.size());
    segments.push_back({{crossed[0], crossed[1]}});
  }
  std::vector<engine::Polyline> lines;
  // From a segment's end on, as long as another one shares its edge.
  const auto follow = [&](std::size_t index, std::size_t from, engine::Polyline& line) {
    for (bool found = true; found;) {
      segments[index].used = true;
      const Edge& ahead = segments[index].edges[1 - from];
      line.push_back(crossing(face, ahead, z));
      found = false;
      for (const std::size_t next : on_edge[ahead]) {
        if (segments[next].used) continue;
        from = segments[next].edges[0] == ahead ? 0 : 1;
        index = next;
        found = true;
        break;
      }
    }
  };
  for (std::size_t first = 0; first < segments.size(); ++first) {
    if (segments[first].used) continue;
    engine::Polyline line;
    follow(first, 1, line);
    std::reverse(line.begin(), line.end());
    follow(first, 0, line);
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace lamina::tools
