#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "engine/model.h"

namespace lamina::tests {

using Corners = std::array<std::array<float, 3>, 3>;

/// Six times the volume that the facets bound, by the divergence theorem; outward facets make it positive.
inline double six_volumes(const engine::TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& facet : mesh.facets) {
    const engine::Vector3 a = mesh.vertices[facet[0]].cast<double>();
    const engine::Vector3 b = mesh.vertices[facet[1]].cast<double>();
    const engine::Vector3 c = mesh.vertices[facet[2]].cast<double>();
    sum += a.dot(b.cross(c));
  }
  return sum;
}

/// The corner of a cube: a tetrahedron of volume 1/6 with outward facets.
inline std::vector<Corners> tetrahedron() {
  const std::array<float, 3> o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  return {{{o, y, x}}, {{o, x, z}}, {{o, z, y}}, {{x, y, z}}};
}

/// A binary STL of these facets; `count` where the header is to say another number.
inline std::string binary_stl(const std::vector<Corners>& facets, const std::string& header = "binary",
                              std::int64_t count = -1) {
  std::string bytes = header;
  bytes.resize(80, ' ');
  const auto stated =
      static_cast<std::uint32_t>(count < 0 ? static_cast<std::int64_t>(facets.size()) : count);
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(stated >> shift & 255U);
  for (const Corners& facet : facets) {
    bytes.append(12, '\0');
    char corners[sizeof(Corners)];
    std::memcpy(corners, facet.data(), sizeof corners);  // tests run on little-endian machines only
    bytes.append(corners, sizeof corners);
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace lamina::tests
