#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "engine/geometry/polygon.h"
#include "engine/layer.h"

namespace lamina::tools {

/// What a section bounds, and what it is made of.
struct FilledSection {
  engine::Region region;
  std::size_t contours = 0;    ///< closed ones
  std::size_t open_lines = 0;  ///< that bound nothing
  double widest_gap = 0.0;     ///< that was closed, mm
};

struct FillOptions {
  double longest_bridge = 2.0;  ///< wider gaps stay open, mm
  double narrowest = 0.0025;    ///< islands and holes of a smaller mean width do not count, mm
};

/// Lines of a section by the number of the solid that they bound, from 1; 0 where it is not known.
using LinesBySolid = std::map<std::size_t, std::vector<engine::Polyline>>;

/// Of lines that come in any order and direction, by a route of its own: ends are joined, the nearest pair
/// first; of loops that cross the union counts, others nest by parity (Clipper). An open line both of whose
/// ends lie inside is a part of the outline as well: the spout of a teapot that goes on inside the pot. Of
/// solids the union counts.
FilledSection filled_section(const LinesBySolid& lines, const FillOptions& options);

/// Of a layer, its curves replaced by chords within `tolerance` (mm).
FilledSection filled_section(const engine::Layer& layer, double tolerance);

}  // namespace lamina::tools
