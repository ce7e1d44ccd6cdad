#include "engine/model.h"

#include <cmath>

#include <Eigen/LU>

namespace lamina::engine {

Box3 bounds(const TriangleMesh& mesh) {
  Box3 box;
  for (const auto& facet : mesh.facets) {
    for (const std::uint32_t v : facet) box.extend(mesh.vertices[v].cast<double>());
  }
  return box;
}

Box3 bounds(const PointCloud& cloud) {
  Box3 box;
  for (const Eigen::Vector3f& point : cloud.points) box.extend(point.cast<double>());
  return box;
}

Box3 control_box(const Model& model) {
  Box3 box;
  for (const Surface& surface : model.surfaces) box.extend(control_box(surface.nurbs.net));
  for (const TriangleMesh& mesh : model.meshes) box.extend(bounds(mesh));
  for (const PointCloud& cloud : model.clouds) box.extend(bounds(cloud));
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
  const Eigen::Matrix3d linear = transform.linear();
  const Eigen::Matrix3d of_normals = linear.inverse().transpose();
  const double scale = std::cbrt(std::abs(linear.determinant()));
  for (PointCloud& cloud : result.clouds) {
    for (Eigen::Vector3f& point : cloud.points) point = (transform * point.cast<double>()).cast<float>();
    for (Eigen::Vector3f& normal : cloud.normals)
      normal = (of_normals * normal.cast<double>()).normalized().cast<float>();
    for (float& spacing : cloud.spacings) spacing *= static_cast<float>(scale);
    cloud.spacing *= scale;
    cloud.noise *= scale;
  }
  return result;
}

}  // namespace lamina::engine
