#include "gcode/plan/walls.h"

#include <algorithm>

#include "gcode/plan/bead.h"
#include "gcode/region/polygon_clipping.h"

namespace lamina::gcode {
namespace {

using engine::Region;

/// Share of a spacing by which two passes may overlap before the wall is left out.
constexpr double kOverlapLimit = 0.4;

double level_width(std::size_t level, const WallWidths& widths) {
  return level == 0 ? widths.outer : widths.inner;
}

std::vector<engine::Loop> loops_of(const Region& region) {
  std::vector<engine::Loop> loops;
  for (const engine::Polygon& polygon : region) {
    loops.push_back(polygon.outer);
    loops.insert(loops.end(), polygon.holes.begin(), polygon.holes.end());
  }
  return loops;
}

}  // namespace

double wall_depth(std::size_t level, const WallWidths& widths) {
  if (level == 0) return 0.5 * widths.outer;
  const double outer = bead_spacing(widths.outer, widths.height);
  const double inner = bead_spacing(widths.inner, widths.height);
  return 0.5 * widths.outer + 0.5 * (outer + inner) + static_cast<double>(level - 1) * inner;
}

Walls make_walls(const engine::Polygon& polygon, std::size_t loops, const WallWidths& widths) {
  const Region outline{polygon};
  Walls walls;
  Region reached = outline;
  for (std::size_t level = 0; level < loops; ++level) {
    const double spacing = bead_spacing(level_width(level, widths), widths.height);
    const Region center = opened(offset(outline, -wall_depth(level, widths), Join::kRound),
                                 0.5 * (1.0 - kOverlapLimit) * spacing);
    if (level == 0) {
      const double covered = engine::area(offset(center, 0.5 * widths.outer, Join::kMiter));
      walls.narrow_area = std::max(0.0, engine::area(outline) - covered);
    }
    if (center.empty()) return walls;
    walls.levels.push_back(loops_of(center));
    reached = center;
  }
  const double flank =
      loops == 0 ? 0.0 : 0.5 * bead_spacing(level_width(loops - 1, widths), widths.height) - widths.overlap;
  walls.inside = offset(reached, -flank, Join::kRound);
  return walls;
}

}  // namespace lamina::gcode
