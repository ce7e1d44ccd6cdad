#pragma once

#include <vector>

#include "engine/geometry/polygon.h"

namespace lamina::tools {

/// What lines make when their ends are joined.
struct JoinedLoops {
  std::vector<engine::Loop> loops;
  std::vector<engine::Polyline> open;  ///< an end of theirs found no partner
  double widest_gap = 0.0;             ///< that was joined across, mm
};

/// Joins the ends of lines, the nearest pair first, across gaps of at most `widest_gap` (mm). A line whose
/// own ends are the nearest closes by itself.
JoinedLoops joined_loops(const std::vector<engine::Polyline>& lines, double widest_gap);

}  // namespace lamina::tools
