#include "engine/model.h"

namespace lamina::engine {

Box3 control_box(const Model& model) {
  Box3 box;
  for (const Surface& surface : model.surfaces) box.extend(control_box(surface.nurbs.net));
  return box;
}

Model transformed(const Model& model, const Eigen::Affine3d& transform) {
  Model result = model;
  for (Surface& surface : result.surfaces) {
    for (Vector4& point : surface.nurbs.net.points) point = transform.matrix() * point;
  }
  return result;
}

}  // namespace lamina::engine
