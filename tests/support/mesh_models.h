#pragma once

#include <functional>

#include "engine/model.h"

namespace lamina::tests {

/// Triangles of a surface of revolution about z: the profile as (radius, z) points from bottom to top, turned
/// in `sides` steps; normals outwards when z rises. Ends with radius zero close it.
engine::TriangleMesh revolved_mesh(const std::vector<engine::Vector2>& profile, int sides);

/// A sphere about `centre` in `rings` by `sides` facets, its vertices on the sphere.
engine::TriangleMesh sphere_mesh(const engine::Vector3& centre, double radius, int rings, int sides);

engine::TriangleMesh box_mesh(const engine::Vector3& low, const engine::Vector3& high);

engine::Model model_of(std::string name, std::vector<engine::TriangleMesh> meshes);

}  // namespace lamina::tests
