#pragma once

#include "engine/geometry/planar_curve.h"

namespace lamina::reference {

/// Chords of a curve that ends where it began, no point of it farther than `tolerance` (mm, positive) from
/// them: the repeated last point is left out.
engine::Loop flatten_closed(const engine::PlanarCurve& curve, double tolerance);

/// The curve through a chain of points by straight pieces (degree 1, chord-length parameters on [0, 1]).
engine::PlanarCurve polyline_curve(const engine::Polyline& points);

}  // namespace lamina::reference
