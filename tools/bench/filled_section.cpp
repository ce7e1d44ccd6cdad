#include "tools/bench/filled_section.h"

#include <algorithm>
#include <utility>

#include "gcode/region/layer_region.h"
#include "gcode/region/polygon_clipping.h"
#include "tools/bench/joined_loops.h"
#include "tools/bench/true_union.h"

namespace lamina::tools {
namespace {

bool contains(const engine::Region& region, const engine::Vector2& place) {
  bool inside = false;
  for (const engine::Polygon& polygon : region) {
    inside = inside != (gcode::side_of_loop(place, polygon.outer) > 0);
    for (const engine::Loop& hole : polygon.holes) inside = inside != (gcode::side_of_loop(place, hole) > 0);
  }
  return inside;
}

FilledSection filled_solid(const std::vector<engine::Polyline>& lines, const FillOptions& options) {
  const JoinedLoops joined = joined_loops(lines, options.longest_bridge);
  std::vector<engine::Region> regions;
  for (const engine::Loop& loop : joined.loops) regions.push_back(gcode::fill_even_odd({loop}));
  FilledSection section;
  section.widest_gap = joined.widest_gap;
  const engine::Region closed = true_nesting(regions, options.narrowest);
  for (const engine::Polyline& line : joined.open) {
    if (contains(closed, line.front()) && contains(closed, line.back())) {
      regions.push_back(gcode::fill_even_odd({line}));
    } else {
      ++section.open_lines;
    }
  }
  section.region = true_nesting(regions, options.narrowest);
  return section;
}

}  // namespace

FilledSection filled_section(const LinesBySolid& lines, const FillOptions& options) {
  FilledSection section;
  std::vector<engine::Region> solids;
  for (const auto& [solid, its_lines] : lines) {
    FilledSection filled = filled_solid(its_lines, options);
    solids.push_back(std::move(filled.region));
    section.open_lines += filled.open_lines;
    section.widest_gap = std::max(section.widest_gap, filled.widest_gap);
  }
  section.region = true_union(solids, options.narrowest);
  if (solids.size() > 1) {
    // Solids that touch: sides that coincide but for rounding are none.
    section.region = gcode::offset(section.region, options.narrowest, gcode::Join::kMiter);
    section.region = gcode::offset(section.region, -options.narrowest, gcode::Join::kMiter);
  }
  for (const engine::Polygon& polygon : section.region) section.contours += 1 + polygon.holes.size();
  return section;
}

FilledSection filled_section(const engine::Layer& layer, double tolerance) {
  FilledSection section;
  section.region = gcode::make_region(layer, {tolerance}).region;
  section.contours = static_cast<std::size_t>(std::count_if(
      layer.closed.begin(), layer.closed.end(), [](const auto& contour) { return !contour.touch; }));
  section.open_lines = layer.open.size();
  for (const engine::BridgedGap& gap : layer.report.bridged_gaps)
    section.widest_gap = std::max(section.widest_gap, gap.width());
  return section;
}

}  // namespace lamina::tools
