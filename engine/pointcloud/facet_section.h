#pragma once

#include <cstdint>

#include "engine/pointcloud/front_state.h"
#include "engine/pointcloud/section_arc.h"

namespace lamina::engine {

/// Appends what the plane at height z and a triangle have in common: a straight arc, an edge or a vertex in
/// the plane, or the whole triangle. Triangles that share an edge get the same point on it, to the last bit.
/// `surface` is the number that the arcs carry. A triangle without area in space gives nothing.
void cut_facet(const FrontFacet& facet, std::uint32_t surface, double z, Section& section);

}  // namespace lamina::engine
