#include "engine/model.h"

namespace lamina::engine {
Box3 bounds(const TriangleMesh& mesh) {
  Box3 box;
  for (const auto& facet : mesh.facets) {
    for (const std::uint32_t v : facet) box.extend(mesh.vertices[v].cast<double>());
  }
  return box;
}

Box3 control_box(const Model& model) {
  Box3 box;
  for (const Surface& surface : model.surfaces) box.extend(control_box(surface.nurbs.net));
  for (const TriangleMesh& mesh : model.meshes) box.extend(bounds(mesh));
  return box;
}

Model transformed(const Model& model, const Eigen::Affine3d& transform) {
  Model result = model;
  for (Surface& surface : result.surfaces) {
    for (Vector4& point : surface.nurbs.net.points) point = transform.matrix() * point;
  }
  for (TriangleMesh& mesh : result.meshes) {
    for (Eigen::Vector3f& vertex : mesh.vertices) {
      vertex = (transform * vertex.cast<double>()).cast<float>();
    }
  }
  return result;
}

}  // namespace lamina::engine
