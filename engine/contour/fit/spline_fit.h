#pragma once

#include <optional>
#include <vector>

#include "engine/contour/fit/spline_search.h"

namespace lamina::engine {

struct SplineFit {
  std::vector<PlanarCurve>
      curves;  ///< in order, each beginning where the one before ends, with the same tangent
  double greatest_distance = 0.0;  ///< measured, mm; at most the tolerance
  std::optional<SplineHint> hint;  ///< for the next chain of the same contour
};

/// B-splines with few control points along an open smooth chain, or along a closed one taken from its first
/// node to itself.
///
/// Every spline goes through its end nodes along their tangents, so the joints are G1. A chain that turns a
/// lot for the tolerance is cut at nodes into parts of about ten to twenty spans each: the search stays small
/// and the time linear. A part that no spline with fewer control points than its nodes' own cubics fits is
/// cut in two, down to single segments, whose cubic is the curve.
///
/// The distance is that of the cubics between the nodes too, and a curve that does not run along with the
/// nodes is refused. Parameters are near arc length, mm, only where that costs no control points.
SplineFit fit_splines(const SmoothChain& chain, const SplineFitOptions& options,
                      const std::optional<SplineHint>& hint = std::nullopt);

}  // namespace lamina::engine
