#pragma once

#include <cstddef>
#include <vector>

#include "engine/contour/contour_node.h"
#include "engine/pointcloud/section_arc.h"

namespace lamina::engine {

/// A face in the plane: outer rim counter-clockwise, inner ones clockwise.
struct FaceOutline {
  NodeChain outer;
  std::vector<NodeChain> inner;
};

/// What becomes of the patches, edges and vertices that lie in the plane.
struct InPlane {
  std::vector<FaceOutline> faces;
  std::vector<NodeChain> touch_curves;   ///< closed or open
  std::vector<Vector2> touch_points;     ///< candidates; those on a contour are not yet left out
  std::vector<SectionArc> section_arcs;  ///< edges that are part of the section, all crossing arcs included
};

struct InPlaneOptions {
  double epsilon = 0.05;   ///< faces narrower than this are curves, mm
  double joined = 0.0001;  ///< ends of arcs this near are one point, mm
  double coincident =
      0.01;  ///< chords of two edges this near are the same edge, mm; twice the chord tolerance or more
};

/// Sorts out what lies in the plane, by what meets at each edge:
/// - patches in the plane are united into faces, by their rims: the cost does not depend on their area. One
/// narrower than
///   epsilon is a curved surface that the plane grazes: a touch curve, or a touch point.
/// - an edge between a patch below and one above belongs to the section.
/// - an edge between two patches on the same side is a touch curve; so is the rim of an open model, unless
/// the wall stands
///   upright on it: then the rim is its section.
/// - an edge between a face and a patch below belongs to the section, unless the face itself
///   stands for it (the top of a box). An edge between a face and a patch above is the face's alone (its
///   bottom).
InPlane sort_out_in_plane(const Section& section, const InPlaneOptions& options);

/// Distance of a place from a chain, mm.
double distance_to_chain(const Vector2& place, const NodeChain& chain);

}  // namespace lamina::engine
