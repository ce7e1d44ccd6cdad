#pragma once

#include <vector>

#include "engine/geometry/curve_piece.h"
#include "engine/geometry/polygon.h"

namespace lamina::engine {

/// Pieces in order; each begins exactly where the one before ends, and the last of a closed curve ends
/// exactly where the first begins.
struct PieceCurve {
  std::vector<CurvePiece> pieces;
  bool closed = false;
};

/// Point at u in [0, number of pieces]: the whole part is the piece, the rest the place on it.
Vector2 point_on(const PieceCurve& curve, double u);

/// Arc length, mm.
double length(const PieceCurve& curve);

/// A box that contains the curve; empty without pieces.
Box2 bounds(const PieceCurve& curve);

/// Area inside a closed curve, mm^2, positive counter-clockwise: exact for lines and arcs, by Gauss
/// quadrature of sufficient order for splines.
double signed_area(const PieceCurve& curve);

/// Points on the curve such that no point of it is farther than `tolerance` (mm, positive) from the chain.
/// The last point of a closed curve is not repeated. The chords are inscribed: see balanced_chords.h for
/// those that straddle the curve.
Polyline flatten(const PieceCurve& curve, double tolerance);

/// Points on the curve, evenly spaced along its arc length, neighbours at most `step` mm (positive) apart
/// along the curve, to 1e-6 of the step. Both ends of an open curve are included; the last point of a closed
/// one is not repeated.
Polyline sample_evenly(const PieceCurve& curve, double step);

}  // namespace lamina::engine
