#include "engine/model.h"

#include "engine/nurbs/bezier.h"
#include "engine/nurbs/bounds.h"

namespace lamina::engine {
namespace {

constexpr double kBoundsTolerance = 1e-3;

/// Of the vertices that facets use.
Box3 bounds(const TriangleMesh& mesh) {
  Box3 box;
  for (const auto& facet : mesh.facets) {
    for (const std::uint32_t v : facet) box.extend(mesh.vertices[v].cast<double>());
  }
  return box;
}

}  // namespace

Box3 control_box(const Model& model) {
  Box3 box;
  for (const Surface& surface : model.surfaces) box.extend(control_box(surface.nurbs.net));
  for (const TriangleMesh& mesh : model.meshes) box.extend(bounds(mesh));
  return box;
}

Box3 model_bounds(const Model& model) {
  Box3 known;
  for (const Surface& surface : model.surfaces) {
    const NurbsSurface& nurbs = surface.nurbs;
    for (const double u : {nurbs.first_u(), nurbs.last_u()}) {
      for (const double v : {nurbs.first_v(), nurbs.last_v()}) known.extend(evaluate(nurbs, u, v));
    }
  }
  for (const Surface& surface : model.surfaces) {
    if (known.contains(control_box(surface.nurbs.net))) continue;
    known = surface_bounds(bezier_patches(surface.nurbs), kBoundsTolerance, known);
  }
  for (const TriangleMesh& mesh : model.meshes) known.extend(bounds(mesh));
  return known;
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
