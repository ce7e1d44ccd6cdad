#pragma once

#include <cstddef>
#include <vector>

#include "engine/contour/fit/smooth_chain.h"
#include "engine/geometry/curve_piece.h"

namespace lamina::engine {

enum class RunShape { kLine, kArc, kFree };

/// Nodes [first, last] of a smooth chain that have a shape in common; neighbours share a node.
struct Run {
  RunShape shape = RunShape::kFree;
  std::size_t first = 0;
  std::size_t last = 0;
  Vector2 centre = Vector2::Zero();  ///< of an arc
  double radius = 0.0;               ///< of an arc, mm
  double turning = 0.0;              ///< of an arc: 1 counter-clockwise, -1 clockwise
};

/// A chain and the runs that cover it from its first node to its last.
struct RunCover {
  SmoothChain chain;  ///< as given, or a closed one turned so that it begins where a line or an arc does
  std::vector<Run> runs;
};

/// Finds the straight lines and circular arcs of a smooth chain; what lies between is free.
///
/// A run holds when each node lies within `tolerance` (mm) of the line or circle and each tangent is so
/// parallel that the segments' cubics do too. Runs are taken from the front, each as long as it holds, and
/// then only if they are no accident: any smooth curve lies within the tolerance of a circle over some
/// length, but there the deviation grows with the third or fourth power of the length, whereas a true line or
/// arc ends at once. So a run is refused if under 64 times the tolerance it would be more than 1.3 times as
/// long (a third power gives 2.6, a fourth one 1.8, half of the excess at the end of a chain). An ellipse or
/// a spiral is therefore free all along. Time O(n log n) at worst, in practice O(n).
RunCover recognise_runs(SmoothChain chain, double tolerance);

/// The pieces of a line or arc run: one, or two arcs where an arc turns by more than about 240 degrees.
std::vector<CurvePiece> exact_pieces(const SmoothChain& chain, const Run& run);

}  // namespace lamina::engine
