#pragma once

#include <vector>

#include "engine/geometry/vector.h"

namespace lamina::engine {

/// A chain of straight segments, mm. Open unless a function says that it takes it as closed.
using Polyline = std::vector<Vector2>;

/// A closed chain: the last vertex joins the first, which is not repeated.
using Loop = std::vector<Vector2>;

/// Filled area: outer loop counter-clockwise, holes clockwise, none of them crossing another.
struct Polygon {
  Loop outer;
  std::vector<Loop> holes;
};

/// Filled areas of a layer; the polygons are disjoint.
using Region = std::vector<Polygon>;

/// Signed area of a closed loop, mm^2: positive when counter-clockwise (shoelace formula).
double signed_area(const Loop& loop);

/// Length of an open chain, mm.
double length(const Polyline& line);

/// Length of a closed loop, its last side included, mm.
double perimeter(const Loop& loop);

/// Whether a point lies inside a closed loop, by parity of the crossings of a ray.
bool contains(const Loop& loop, const Vector2& point);

/// Area of a region, holes subtracted, mm^2.
double area(const Region& region);

/// Smallest box around every outer loop; empty for an empty region.
Box2 bounds(const Region& region);

}  // namespace lamina::engine
