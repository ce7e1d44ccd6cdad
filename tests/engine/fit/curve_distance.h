#pragma once

#include <cstddef>

#include "engine/geometry/piece_curve.h"
#include "tests/engine/fit/node_shapes.h"

namespace lamina::tests {

/// Dense points of the pieces, by routes of their own: lines by their ends, arcs by their angles, splines
/// through `engine::evaluate`. `per_piece` intervals each.
engine::Polyline dense_points(const engine::PieceCurve& curve, std::size_t per_piece);

engine::Polyline dense_points(const ParametricCurve& curve, std::size_t count);

/// Greatest distance of a point from a chain: every segment is looked at.
double greatest_distance(const engine::Polyline& points, const engine::Polyline& chain);

/// Every so-manieth point.
engine::Polyline every(const engine::Polyline& points, std::size_t step);

/// Greatest jump between the pieces' ends, the seam of a closed curve included.
double greatest_gap(const engine::PieceCurve& curve);

/// Greatest angle (rad) between the tangents where pieces meet; of a closed curve at the seam too.
double greatest_kink(const engine::PieceCurve& curve);

}  // namespace lamina::tests
