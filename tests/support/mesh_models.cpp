#include "tests/support/mesh_models.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace lamina::tests {

using engine::TriangleMesh;
using engine::Vector2;
using engine::Vector3;

TriangleMesh revolved_mesh(const std::vector<Vector2>& profile, int sides) {
  TriangleMesh mesh;
  const auto n = static_cast<std::uint32_t>(sides);
  for (const Vector2& point : profile) {
    for (int k = 0; k < sides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / sides;
      mesh.vertices.push_back(
          Vector3(point.x() * std::cos(angle), point.x() * std::sin(angle), point.y()).cast<float>());
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < profile.size(); ++ring) {
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t a = ring * n + k;
      const std::uint32_t b = ring * n + (k + 1) % n;
      if (profile[ring].x() > 0.0) mesh.facets.push_back({a, b, b + n});
      if (profile[ring + 1].x() > 0.0) mesh.facets.push_back({a, b + n, a + n});
    }
  }
  return mesh;
}

TriangleMesh sphere_mesh(const Vector3& centre, double radius, int rings, int sides) {
  std::vector<Vector2> profile;
  for (int k = 0; k <= rings; ++k) {
    const double angle = std::numbers::pi * k / rings;
    const bool pole = k == 0 || k == rings;
    profile.emplace_back(pole ? 0.0 : radius * std::sin(angle), -radius * std::cos(angle));
  }
  TriangleMesh mesh = revolved_mesh(profile, sides);
  for (Eigen::Vector3f& vertex : mesh.vertices) vertex += centre.cast<float>();
  return mesh;
}

TriangleMesh box_mesh(const Vector3& low, const Vector3& high) {
  TriangleMesh mesh;
  for (int k = 0; k < 8; ++k) {
    mesh.vertices.push_back(Vector3((k & 1) != 0 ? high.x() : low.x(), (k & 2) != 0 ? high.y() : low.y(),
                                    (k & 4) != 0 ? high.z() : low.z())
                                .cast<float>());
  }
  const std::uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                     {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
  for (const auto& q : quads) {
    mesh.facets.push_back({q[0], q[1], q[2]});
    mesh.facets.push_back({q[0], q[2], q[3]});
  }
  return mesh;
}

engine::Model model_of(std::string name, std::vector<TriangleMesh> meshes) {
  engine::Model model;
  model.name = std::move(name);
  model.meshes = std::move(meshes);
  return model;
}

}  // namespace lamina::tests
