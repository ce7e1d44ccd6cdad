#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/geometry/polygon.h"
#include "engine/geometry/vector.h"

namespace lamina::tools {

/// Triangles of one face, or of a whole mesh file; corners on the sides of neighbouring faces are not shared.
struct FaceTriangles {
  std::vector<engine::Vector3> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The segments in which the plane at height z cuts the triangles, linked along the edges that they share.
/// Corners in the plane count as above it.
std::vector<engine::Polyline> triangle_lines(const FaceTriangles& face, double z);

}  // namespace lamina::tools
