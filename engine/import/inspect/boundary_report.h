#pragma once

#include <cstddef>
#include <optional>

#include "engine/model.h"

namespace lamina::engine {

/// How the faces of a model meet.
struct BoundaryReport {
  std::size_t edges = 0;              ///< trim curves, sides of untrimmed surfaces, sides of triangles
  std::size_t open_edges = 0;         ///< those without another edge along them
  Vector3 open_at = Vector3::Zero();  ///< a point of the first of them
  double largest_gap = 0.0;           ///< between edges that lie along each other, mm
  Vector3 largest_gap_at = Vector3::Zero();
  double joined_within = 0.0;  ///< what counts as lying along each other, mm
  double area = 0.0;           ///< mm^2, of all faces
  /// mm^3; nothing where the faces do not close, or more than two meet along an edge, so that sides are
  /// unclear.
  std::optional<double> volume{};

  bool is_closed() const { return open_edges == 0; }
};

/// Compares points along every edge with all other edges of the same solid, faces of no known solid counting
/// as one. Edges count as joined where they are within a thousandth of the model's diagonal. The volume is
/// that of the faces turned alike along their edges, voids (shells whose box lies in another's) taken off;
/// known solids are added up, whether or not they overlap.
BoundaryReport boundary_report(const Model& model);

}  // namespace lamina::engine
