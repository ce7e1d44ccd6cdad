#pragma once

#include <string>
#include <vector>

#include "engine/geometry/vector.h"
#include "engine/nurbs/surface.h"

namespace lamina::engine {

/// A surface of the model and where it came from.
struct Surface {
  NurbsSurface nurbs;
  int entity_type = 0;     ///< IGES entity type number, such as 128
  int directory_line = 0;  ///< sequence number of its directory entry in the file, such as 255
};

/// What is sliced: surfaces in mm that together bound a solid. Nothing is promised about topology.
struct Model {
  std::string name;  ///< the file's stem
  std::vector<Surface> surfaces;
};

/// Distance within which points of the model count as the same and a plane touches it, mm (dissertation p.
/// 156).
inline constexpr double kModelTolerance = 1e-6;

/// Box around all control nets, hence around the model; tight only where the nets are.
Box3 control_box(const Model& model);

/// Box around the surfaces themselves: too large or too small by at most a micrometre on any side.
Box3 model_bounds(const Model& model);

/// The model turned, scaled and moved.
Model transformed(const Model& model, const Eigen::Affine3d& transform);

}  // namespace lamina::engine
