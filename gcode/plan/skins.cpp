#include "gcode/plan/skins.h"

#include <cmath>

#include "gcode/region/polygon_clipping.h"

namespace lamina::gcode {
namespace {

using engine::Region;

/// Where neighbouring layers differ by less than this it is rounding and chords, not a surface, mm.
constexpr double kNoise = 0.02;

/// Where `cover` leaves the inside bare, grown by the anchor.
Region bare(const Region& inside, const Region& cover, double anchor) {
  return intersect(offset(opened(subtract(inside, cover), kNoise), anchor, Join::kMiter), inside);
}

Region without_small_parts(Region region, double min_area) {
  std::erase_if(region, [&](const engine::Polygon& polygon) { return engine::area({polygon}) < min_area; });
  return region;
}

}  // namespace

Skins divide_inside(const Region& inside, const Neighbours& neighbours, const SkinOptions& options) {
  const double line = options.line_spacing;
  Region near_surface;
  if (options.has_top) near_surface = bare(inside, neighbours.covered_above, line);
  if (options.has_bottom) near_surface = unite({near_surface, bare(inside, neighbours.covered_below, line)});

  Skins skins;
  skins.sparse =
      without_small_parts(opened(subtract(inside, near_surface), 0.5 * line), options.min_area_solid);
  Region rest = subtract(inside, skins.sparse);
  if (options.has_top) {
    skins.top = opened(intersect(rest, bare(inside, neighbours.above, line)), 0.5 * line);
    rest = subtract(rest, skins.top);
  }
  if (options.has_bottom) {
    skins.bottom = opened(intersect(rest, bare(inside, neighbours.below, line)), 0.5 * line);
    rest = subtract(rest, skins.bottom);
  }
  skins.solid = rest;
  return skins;
}

}  // namespace lamina::gcode
