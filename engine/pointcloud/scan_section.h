#pragma once

#include <cstdint>
#include <vector>

#include "engine/layer_report.h"
#include "engine/pointcloud/front_state.h"
#include "engine/pointcloud/section_arc.h"

namespace lamina::engine {

/// Appends what the plane at height z and a scanned surface have in common: arcs with a node on every line of
/// a grid of half the scan's spacing that they cross. Across holes of the scan, up to `widest_hole` (mm)
/// wide, the arcs go on as the surface around it bends; these places are returned. `surface` is the number
/// that the arcs carry.
std::vector<BridgedGap> cut_scan(const FrontScan& scan, std::uint32_t surface, double z, double widest_hole,
                                 Section& section);

}  // namespace lamina::engine
