#pragma once

#include <vector>

#include "engine/contour/fit/walked_chain.h"
#include "engine/geometry/planar_curve.h"

namespace lamina::engine {

/// Greatest distance of a chain's cubics from each knot span of a spline that was fitted to `samples` of it,
/// mm, measured at all nodes and at no fewer than ten places per knot span; infinite where the spline does
/// not run along with the chain, but turns back or strays between the places. Spline and samples are relative
/// to the chain's first node.
std::vector<double> span_distances(const PlanarCurve& curve, const std::vector<FitSample>& samples,
                                   const WalkedChain& walk);

}  // namespace lamina::engine
