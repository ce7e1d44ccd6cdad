#include "gcode/plan/infill.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "gcode/plan/bead.h"
#include "gcode/plan/raster.h"
#include "gcode/region/polygon_clipping.h"

namespace lamina::gcode {
namespace {

using engine::Polygon;
using engine::Region;

/// Solid lines may be joined along the boundary as long as the way stays in the gap between them, in
/// spacings.
constexpr double kSolidLink = 4.0;

/// Keeps the outermost lines off the boundary of the area that they are clipped to, mm.
constexpr double kInsideClip = 1e-3;

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};

Extent extent_across(const engine::Loop& loop, double angle) {
  const engine::Vector2 across(-std::sin(angle), std::cos(angle));
  Extent extent;
  for (const engine::Vector2& vertex : loop) {
    extent.low = std::min(extent.low, vertex.dot(across));
    extent.high = std::max(extent.high, vertex.dot(across));
  }
  return extent;
}

void append_lines(const Polygon& area, double inset, const RasterLines& lines, double max_link, Role role,
                  double width, std::vector<BeadPath>& paths) {
  for (const Polygon& clip : offset({area}, -inset, Join::kRound)) {
    for (engine::Polyline& chain : raster(clip, lines, max_link)) {
      paths.push_back({role, width, false, std::move(chain)});
    }
  }
}

}  // namespace

double infill_angle(const InfillOptions& options, std::size_t layer) {
  return options.angle + (layer % 2 == 0 ? 0.0 : 90.0);
}

std::vector<BeadPath> fill_solid(const Region& area, Role role, double width, double height, double angle) {
  const double nominal = bead_spacing(width, height);
  std::vector<BeadPath> paths;
  for (const Polygon& polygon : area) {
    const Extent extent = extent_across(polygon.outer, radians(angle));
    const double lines = std::max(1.0, std::round((extent.high - extent.low) / nominal));
    const double spacing = (extent.high - extent.low) / lines;
    const double fitted_width = bead_width(spacing, height);
    if (fitted_width < height) continue;  // too thin for a bead
    append_lines(polygon, 0.5 * spacing - kInsideClip, {radians(angle), spacing, extent.low},
                 kSolidLink * spacing, role, fitted_width, paths);
  }
  return paths;
}

std::vector<BeadPath> fill_sparse(const Region& area, const InfillOptions& options, double width,
                                  double height, std::size_t layer) {
  std::vector<BeadPath> paths;
  if (options.density <= 0.0) return paths;
  const double solid = bead_spacing(width, height);
  const bool grid = options.pattern == InfillPattern::kGrid;
  const double spacing = solid / options.density * (grid ? 2.0 : 1.0);
  const double angle = radians(infill_angle(options, layer));
  for (const Polygon& polygon : area) {
    append_lines(polygon, 0.5 * solid, {angle, spacing, 0.0}, options.anchor_max, Role::kSparseInfill, width,
                 paths);
    if (!grid) continue;
    append_lines(polygon, 0.5 * solid, {angle + 0.5 * std::numbers::pi, spacing, 0.0}, options.anchor_max,
                 Role::kSparseInfill, width, paths);
  }
  return paths;
}

}  // namespace lamina::gcode
