#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/geometry/vector.h"

namespace lamina::engine {

/// A point that surface and plane have in common.
struct SectionNode {
  Vector2 position;
  Vector2 tangent;  ///< unit tangent of the section in the arc's direction; zero where the surface has none
  Vector2 parameters = Vector2::Zero();  ///< (u, v) of the patch, each 0 to 1
};

/// On which side of an in-plane edge the patch lies that the edge belongs to.
enum class ArcKind : std::uint8_t {
  kCrossing,   ///< the patch passes through the plane
  kEdgeBelow,  ///< an edge of a patch that lies in the plane; the patch is below it
  kEdgeAbove,
  kFlatRim,  ///< an edge of a patch that lies in the plane as a whole
};

/// A piece of the section: nodes [first, first + count) of the layer's node array, at least two.
struct SectionArc {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  std::uint32_t surface = 0;  ///< of the model
  ArcKind kind = ArcKind::kCrossing;
  bool upright = false;  ///< of an edge in the plane: the patch stands upright on it
};

/// A vertex of a patch in the plane, no edge of it in the plane: the tip of a cone, the corner of a box.
struct TouchCandidate {
  Vector2 position;
  bool above = false;  ///< the patch lies above the plane
};

/// A piece of a patch that lies in the plane: its outline is the arcs from `first_arc` on.
struct FlatPiece {
  std::uint32_t first_arc = 0;
  std::uint32_t arc_count = 0;
  double size = 0.0;  ///< larger side, mm
  bool hole = false;  ///< what its outline encloses is not there
};

/// All that one plane and the patches have in common, unordered.
struct Section {
  std::vector<SectionNode> nodes;
  std::vector<SectionArc> arcs;
  std::vector<SectionArc> flat_rims;  ///< outlines of flat pieces
  std::vector<FlatPiece> flats;
  std::vector<TouchCandidate> touches;
  std::size_t cells = 0;  ///< sub-patches looked at
  std::size_t unresolved_cells =
      0;  ///< sub-patches at the smallest size whose section was taken from their corners

  void clear() {
    nodes.clear();
    arcs.clear();
    flat_rims.clear();
    flats.clear();
    touches.clear();
    cells = 0;
    unresolved_cells = 0;
  }
  const SectionNode& front(const SectionArc& arc) const { return nodes[arc.first]; }
  const SectionNode& back(const SectionArc& arc) const { return nodes[arc.first + arc.count - 1]; }
};

}  // namespace lamina::engine
