#pragma once

#include "engine/nurbs/curve.h"
#include "engine/nurbs/surface.h"

namespace lamina::engine {

/// The surface of the straight lines between points of two curves at equal relative parameter: u in [0, 1]
/// runs along both, v in [0, 1] from the first curve to the second. Degrees and knots are made equal first.
/// Exact as a set of points; where the weights of the curves differ, v is not the length along a line. The
/// NURBS Book, section 8.4.
NurbsSurface ruled_surface(const NurbsCurve& first, const NurbsCurve& second);

}  // namespace lamina::engine
