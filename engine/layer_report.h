#pragma once

#include <cstddef>
#include <vector>

#include "engine/geometry/vector.h"

namespace lamina::engine {

/// A place where the model has no surface and the contour was led straight across.
struct BridgedGap {
  Vector2 from = Vector2::Zero();
  Vector2 to = Vector2::Zero();

  double width() const { return (to - from).norm(); }
};

/// What was counted, and all that was imperfect, while one layer was made.
struct LayerReport {
  /// Of one thread, where a clock was given.
  struct Seconds {
    double section = 0.0;   ///< cutting patches
    double contours = 0.0;  ///< linking, bridging, uniting, planar faces
    double fit = 0.0;
  };

  std::size_t active_patches = 0;
  std::size_t active_facets = 0;
  std::size_t patches_added = 0;
  std::size_t patches_removed = 0;
  std::size_t cells = 0;  ///< sub-patches looked at
  std::size_t unresolved_cells =
      0;  ///< sub-patches of the smallest size whose section was taken from their corners
  std::size_t arcs = 0;
  std::size_t nodes = 0;
  std::size_t branchings = 0;    ///< places where more than two arcs meet
  std::size_t tiles = 0;         ///< of the layer grid
  std::size_t shared_cells = 0;  ///< cells of the layer grid that contours share
  std::size_t close_places =
      0;  ///< pairs of contour pieces in one cell that do not meet: thin walls, narrow gaps
  std::size_t meetings = 0;           ///< pairs of contour pieces that cross or touch
  std::size_t resolved_contours = 0;  ///< chains that went through the arrangement because they meet
  std::size_t components = 0;
  std::size_t control_points = 0;
  double greatest_fit_distance = 0.0;  ///< of a fitted curve from the nodes, mm
  std::vector<BridgedGap> bridged_gaps;
  std::vector<BridgedGap> open_gaps;  ///< ends left open, and the nearest other end: wider than the limit
  std::size_t dropped_pieces = 0;     ///< pieces left aside: overshoot at overlaps, walls inside the solid
  double dropped_length = 0.0;        ///< mm
  std::size_t contained_touches = 0;  ///< touch points and edges left out because they lie on a contour
  Seconds seconds;
};

}  // namespace lamina::engine
