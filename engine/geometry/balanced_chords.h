#pragma once

#include "engine/geometry/piece_curve.h"

namespace lamina::engine {

/// A chain of chords that straddle the curve, so that solids do not shrink and holes do not narrow: no point
/// of either is farther than `tolerance` (mm, positive) from the other, and the signed distance between them
/// has the mean zero: the chain bounds the same area as the curve, run by run, to a small part of the chords'
/// own sagitta.
///
/// Ends, corners and the ends of lines are kept exactly. Elsewhere the vertices lie outside of the bend by
/// two thirds of the chords' sagitta s, the chords' middles inside by one third; beside a kept end the chord
/// is shorter by the square root of two, which gives it the mean zero as well. So s may be 3/2 of the
/// tolerance, and there are fewer chords than inscribed ones of the same tolerance. The last vertex of a
/// closed curve is not repeated.
Polyline flatten_balanced(const PieceCurve& curve, double tolerance);

}  // namespace lamina::engine
