#pragma once

#include "engine/contour/contour_node.h"
#include "engine/geometry/piece_curve.h"

namespace lamina::engine {

struct PieceFitOptions {
  double tolerance = 0.002;  ///< greatest distance of the splines from the nodes' cubics, mm
  double recognition_tolerance =
      5e-7;                      ///< of lines and arcs from the nodes, mm; above what the nodes are exact to
  double corner_angle = 0.0087;  ///< a tangent that jumps by more is a corner, rad (half a degree)
  int least_degree = 2;          ///< of the splines, 2 to greatest_degree
  int greatest_degree = 5;       ///< to 5
};

struct PieceFit {
  PieceCurve curve;                ///< no pieces if the chain has fewer than two distinct nodes
  double greatest_distance = 0.0;  ///< of the splines from the nodes' cubics, measured, mm
};

/// Lines, arcs and splines for a chain of contour nodes: cut at corners (`smooth_chains`), lines and arcs
/// recognised in between (`recognise_runs`), splines for the rest (`fit_splines`). Every joint is a node; at
/// joints that are no corners the tangents agree. Follows the direction of the chain; a closed curve may
/// begin at another node than the chain.
PieceFit fit_pieces(const NodeChain& chain, const PieceFitOptions& options);

/// Control points of a curve: two for a line, three for an arc, those of its splines.
std::size_t control_count(const PieceCurve& curve);

}  // namespace lamina::engine
