#pragma once

#include <vector>

#include "engine/geometry/vector.h"
#include "engine/nurbs/bezier.h"

namespace lamina::engine {

/// Box around the patches themselves, not their nets: it contains no more than `tolerance` (mm, positive) of
/// empty space on any side, and misses at most `tolerance` of the patches. Patches whose net reaches beyond
/// the points known so far are halved until they do not (branch and bound on the convex-hull property).
/// `known` spans points that are on the surfaces anyway; the result contains it.
Box3 surface_bounds(const std::vector<BezierPatch>& patches, double tolerance, Box3 known = {});

}  // namespace lamina::engine
