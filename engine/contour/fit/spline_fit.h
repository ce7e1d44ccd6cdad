#pragma once

#include <vector>

#include "engine/contour/fit/smooth_chain.h"
#include "engine/geometry/planar_curve.h"

namespace lamina::engine {

struct SplineFitOptions {
  double tolerance = 0.002;  ///< greatest distance of the nodes' cubics from the splines, mm
  int least_degree = 2;      ///< 2 to greatest_degree
  int greatest_degree = 5;   ///< to 5
};

struct SplineFit {
  std::vector<PlanarCurve>
      curves;  ///< in order, each beginning where the one before ends, with the same tangent
  double greatest_distance = 0.0;  ///< measured, mm; at most the tolerance
};

/// B-splines with few control points along an open smooth chain, or along a closed one taken from its first
/// node to itself.
///
/// Every spline goes through its end nodes along their tangents, so the joints are G1. A chain that turns a
/// lot for the tolerance is cut at nodes into parts of about ten to twenty spans each: the search stays small
/// and the time linear. A part that no spline with fewer control points than its nodes' own cubics fits is
/// cut in two, down to single segments, whose cubic is the curve.
///
/// Of one part: single Bezier segments first. Otherwise knots are simple and spread evenly over the error of
/// the previous attempt (de Boor, A Practical Guide to Splines, chapter XII, NEWNOT), and their number is
/// narrowed down until one less fails. Cubic and quintic are tried, the likelier is narrowed, the other
/// degrees have to do with fewer control points. The search is a local one: it finds few control points, not
/// provably the fewest. From the second part of a chain on it starts from what the part before needed, keeps
/// its degree but for every fourth part, and stops within an eighth of the number of spans.
///
/// The distance is that of the cubics between the nodes too: it is measured at all nodes and at no fewer than
/// ten places per knot span, and a curve that does not run along with the nodes is refused. Parameters are
/// near arc length, mm, only where that costs no control points.
SplineFit fit_splines(const SmoothChain& chain, const SplineFitOptions& options);

}  // namespace lamina::engine
