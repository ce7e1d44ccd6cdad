#pragma once

#include <array>
#include <vector>

#include "engine/contour/contour_node.h"
#include "engine/geometry/vector.h"

namespace lamina::engine {

/// Nodes between two corners, mm: a position and a unit tangent each, neighbours apart from each other. A
/// closed smooth chain (a contour without corners) repeats its first node at the end.
struct SmoothChain {
  std::vector<Vector2> positions;
  std::vector<Vector2> tangents;
  bool closed = false;
};

/// Cuts a chain where a node is flagged as a corner or its tangent jumps by more than `corner_angle` (rad).
/// Nodes closer than 1e-9 mm to their predecessor are one node. A tangent that is zero, or that points
/// against both of its node's sides, is taken from the circle through the node and its neighbours instead;
/// where a tangent is unknown on both sides and the sides turn by more than pi / 6 there is a corner. A chain
/// of fewer than two distinct nodes has no smooth chain. A closed chain with corners begins at its first one.
std::vector<SmoothChain> smooth_chains(const NodeChain& chain, double corner_angle);

/// Control points of a cubic Bezier segment.
using Cubic = std::array<Vector2, 4>;

/// The curve that two neighbouring nodes stand for: through both positions along both tangents, with the arms
/// of the best cubic for a circular arc, (2/3) chord / (1 + cos(turn / 2)). Distance from a smooth curve is
/// of fourth order in the spacing, of sixth where the curvature is constant (de Boor, Hoellig, Sabin, High
/// accuracy geometric Hermite interpolation, CAGD 4, 1987).
Cubic hermite_cubic(const SmoothChain& chain, std::size_t segment);

Vector2 point_on(const Cubic& cubic, double u);
Vector2 derivative_on(const Cubic& cubic, double u);

/// Arc length of every segment's cubic, mm, from chord and control polygon (Gravesen, Adaptive subdivision
/// and the length of Bezier curves, 1997): the error is of fourth order.
std::vector<double> segment_lengths(const SmoothChain& chain);

/// Nodes [first, last] of a chain, open.
SmoothChain sub_chain(const SmoothChain& chain, std::size_t first, std::size_t last);

}  // namespace lamina::engine
