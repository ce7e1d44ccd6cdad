#pragma once

#include <cstddef>

#include "engine/pointcloud/front_state.h"
#include "engine/pointcloud/section_arc.h"
#include "engine/pointcloud/trim_region.h"

namespace lamina::engine {

/// How much of a section was there before a patch was cut.
struct SectionMark {
  std::size_t nodes = 0;
  std::size_t arcs = 0;
  std::size_t flat_rims = 0;
  std::size_t flats = 0;
  std::size_t touches = 0;
};

SectionMark mark_of(const Section& section);

/// Keeps of what a patch added since `mark` the part inside the trim loops. Arcs end where the plane meets
/// the trim curve, exactly: on the curve, on the surface and in the plane. Edges along the surface's own
/// border, and those along trim curves in the plane, are left to `add_trim_edges`.
void trim_section(Section& section, const SectionMark& mark, const FrontPatch& patch, double z);

}  // namespace lamina::engine
