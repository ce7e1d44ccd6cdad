#include "gcode/plan/adhesion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "gcode/plan/bead.h"
#include "gcode/region/polygon_clipping.h"

namespace lamina::gcode {
namespace {

using engine::Loop;
using engine::Region;
using engine::Vector2;

double turn(const Vector2& a, const Vector2& b, const Vector2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Lower chain of points sorted by x; the last point is left to the other chain.
template <typename Iterator>
void append_chain(Iterator first, Iterator last, Loop& hull) {
  const std::size_t begin = hull.size();
  for (Iterator it = first; it != last; ++it) {
    while (hull.size() >= begin + 2 && turn(hull[hull.size() - 2], hull.back(), *it) <= 0.0) hull.pop_back();
    hull.push_back(*it);
  }
  hull.pop_back();
}

}  // namespace

Loop convex_hull(const Region& region) {
  std::vector<Vector2> points;
  for (const engine::Polygon& polygon : region) {
    points.insert(points.end(), polygon.outer.begin(), polygon.outer.end());
  }
  if (points.size() < 3) return points;
  std::sort(points.begin(), points.end(), [](const Vector2& a, const Vector2& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  Loop hull;
  append_chain(points.begin(), points.end(), hull);
  append_chain(points.rbegin(), points.rend(), hull);
  return hull;
}

std::vector<BeadPath> make_skirt(const Region& first_layer, const AdhesionOptions& options, double width,
                                 double height, double min_volume) {
  std::vector<BeadPath> loops;
  const Loop hull = convex_hull(first_layer);
  if (hull.size() < 3) return loops;
  double volume = 0.0;
  while (loops.size() < options.skirt_loops || volume < min_volume) {
    const double distance = options.skirt_distance + 0.5 * width +
                            static_cast<double>(loops.size()) * bead_spacing(width, height);
    const Loop loop = offset({{hull, {}}}, distance, Join::kRound).front().outer;
    volume += engine::perimeter(loop) * bead_area(width, height);
    loops.push_back({Role::kSkirt, width, true, loop});
  }
  std::reverse(loops.begin(), loops.end());
  return loops;
}

std::vector<BeadPath> make_brim(const Region& first_layer, const AdhesionOptions& options, double width,
                                double height) {
  Region outlines;
  for (const engine::Polygon& polygon : first_layer) outlines.push_back({polygon.outer, {}});
  outlines = unite({outlines});

  std::vector<BeadPath> loops;
  const double spacing = bead_spacing(width, height);
  const int count = static_cast<int>(std::lround(options.brim_width / spacing));
  for (int i = count - 1; i >= 0; --i) {
    for (const engine::Polygon& polygon :
         offset(outlines, options.brim_gap + 0.5 * width + i * spacing, Join::kRound)) {
      loops.push_back({Role::kBrim, width, true, polygon.outer});
    }
  }
  return loops;
}

}  // namespace lamina::gcode
