#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/geometry/vector.h"
#include "engine/nurbs/curve.h"
#include "engine/nurbs/surface.h"

namespace lamina::engine {

/// A closed loop of curves in a surface's parameter plane: control points (w u, w v, 0, w), each curve begins
/// where the one before ends, to the tolerance that the model was read with.
struct TrimLoop {
  std::vector<NurbsCurve> curves;
};

/// A surface of the model and where it came from. With trim loops only the part of it counts that lies inside
/// them, by parity: outer loops counter-clockwise, holes clockwise, several outer ones possible.
struct Surface {
  NurbsSurface nurbs;
  std::vector<TrimLoop> trim;  ///< empty: the whole surface
  int entity_type = 0;         ///< IGES entity type number, such as 128
  int directory_line = 0;      ///< sequence number of its directory entry in the file, such as 255
  std::uint32_t solid = 0;     ///< number of the solid that it bounds with others; 0: none that is known
};

/// Triangles as a file gives them, mm: not repaired, corners perhaps not shared, normals perhaps reversed.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> facets;  ///< indices of vertices
  std::uint32_t solid = 0;                           ///< as that of a surface
};

/// Points of a scanned surface as `prepare_scan` leaves them, mm, in no order: outliers taken out.
struct PointCloud {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> normals;  ///< of unit length, outwards
  std::vector<float> spacings;           ///< of the points around each one, mm: 1 / sqrt(points per mm^2)
  double spacing = 0.0;                  ///< that three of four points keep, mm
  double noise = 0.0;  ///< standard deviation of the points from their neighbours' surface, mm
};

/// What is sliced: surfaces, triangles and scanned points in mm that together bound a solid. Nothing is
/// promised about topology. Known solids are united, whatever lies in each other; what is of no known solid
/// nests by parity.
struct Model {
  std::string name;  ///< the file's stem
  std::vector<Surface> surfaces;
  std::vector<TriangleMesh> meshes;
  std::vector<PointCloud> clouds;
};

/// Distance within which points of the model count as the same and a plane touches it, mm (dissertation p.
/// 156).
inline constexpr double kModelTolerance = 1e-6;

/// Box around the vertices that facets use.
Box3 bounds(const TriangleMesh& mesh);

/// Box around the points.
Box3 bounds(const PointCloud& cloud);

/// Box around all control nets, hence around the model; tight only where the nets are.
Box3 control_box(const Model& model);

/// The model turned, scaled and moved.
Model transformed(const Model& model, const Eigen::Affine3d& transform);

}  // namespace lamina::engine
