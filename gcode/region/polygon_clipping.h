#pragma once

#include <vector>

#include "engine/geometry/polygon.h"

/// Booleans and offsets of filled areas. The one place that knows the Clipper library (Vatti's algorithm,
/// A generic solution to polygon clipping, CACM 35(7), 1992).
///
/// Coordinates are rounded to a lattice of 1e-6 mm, so a result's vertex is off by at most 0.71e-6 mm from
/// that of exact arithmetic on the rounded input; the rounding of the input adds as much again. Coordinates
/// must stay below 1e6 mm. Every region returned obeys the promise of engine::Region: outer loops
/// counter-clockwise, holes clockwise, polygons disjoint, none empty.
namespace lamina::gcode {

/// How an offset goes around a corner that it moves away from.
enum class Join {
  kRound,  ///< Along an arc: the result is exactly the points at the distance.
  kMiter,  ///< To the corner of the shifted sides, up to three times the distance: undoes a shrinking at a
           ///< corner.
};

/// What lies inside an odd number of the loops, whatever their direction.
engine::Region fill_even_odd(const std::vector<engine::Loop>& loops);

/// What lies in at least one of the regions.
engine::Region unite(const std::vector<engine::Region>& regions);

/// What lies in both.
engine::Region intersect(const engine::Region& a, const engine::Region& b);

/// What lies in `from` and not in `removed`.
engine::Region subtract(const engine::Region& from, const engine::Region& removed);

/// The region grown by `distance` mm, shrunk where that is negative. Arcs are chords that keep within 0.002
/// mm.
engine::Region offset(const engine::Region& region, double distance, Join join);

/// What a disc of this radius (mm) reaches from inside the region, corners kept: parts narrower than its
/// diameter are gone, everything else is as it was.
engine::Region opened(const engine::Region& region, double radius);

/// Whether the point lies inside the loop (+1), outside (-1) or on it (0), on the lattice.
int side_of_loop(const engine::Vector2& point, const engine::Loop& loop);

}  // namespace lamina::gcode
