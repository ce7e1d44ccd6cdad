#pragma once

#include "engine/pointcloud/section_arc.h"
#include "engine/pointcloud/trim_region.h"

namespace lamina::engine {

/// Appends what a plane and the trim curves of a region have in common: curves in the plane as edges, their
/// ends and turning points as touch candidates, and a level surface as a face with the loops as its rims.
/// Chords within `chord_tolerance`, mm.
void add_trim_edges(Section& section, const TrimRegion& region, double z, double chord_tolerance);

}  // namespace lamina::engine
