#include "gcode/region/layer_region.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "engine/geometry/balanced_chords.h"
#include "gcode/region/loop_crossings.h"
#include "gcode/region/polygon_clipping.h"

namespace lamina::gcode {
namespace {

using engine::Loop;
using engine::Region;

using LoopPairs = std::vector<std::pair<std::size_t, std::size_t>>;

bool contains(const Loop& outer, const Loop& inner) {
  for (const engine::Vector2& vertex : inner) {
    const int side = side_of_loop(vertex, outer);
    if (side != 0) return side > 0;
  }
  return false;  // the same loop twice
}

/// How loops lie in each other; loops that cross are not in each other.
struct Nesting {
  std::vector<std::size_t> depth;   ///< Longest chain of loops around this one.
  std::vector<std::size_t> parent;  ///< Smallest loop of depth - 1 around this one; itself at depth 0.
};

Nesting nest(const std::vector<Loop>& loops, const LoopPairs& crossings) {
  const std::set<std::pair<std::size_t, std::size_t>> crossing(crossings.begin(), crossings.end());
  std::vector<double> areas;
  std::vector<engine::Box2> boxes;
  for (const Loop& loop : loops) {
    areas.push_back(std::abs(engine::signed_area(loop)));
    boxes.push_back(engine::bounds({{loop, {}}}));
  }
  std::vector<std::size_t> by_area(loops.size());
  std::iota(by_area.begin(), by_area.end(), 0);
  std::stable_sort(by_area.begin(), by_area.end(),
                   [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });

  Nesting nesting{std::vector<std::size_t>(loops.size(), 0), std::vector<std::size_t>(loops.size(), 0)};
  for (std::size_t rank = 0; rank < by_area.size(); ++rank) {
    const std::size_t inner = by_area[rank];
    nesting.parent[inner] = inner;
    for (std::size_t larger = 0; larger < rank; ++larger) {
      const std::size_t outer = by_area[larger];
      if (crossing.contains(std::minmax(inner, outer)) || !boxes[outer].contains(boxes[inner])) continue;
      if (nesting.depth[outer] + 1 < nesting.depth[inner] || !contains(loops[outer], loops[inner])) continue;
      nesting.depth[inner] = nesting.depth[outer] + 1;
      nesting.parent[inner] = outer;
    }
  }
  return nesting;
}

Region compensate(const Region& region, double growth) {
  return growth == 0.0 ? region : offset(region, growth, Join::kMiter);
}

}  // namespace

FilledContours fill_contours(const std::vector<Loop>& loops) {
  const LoopPairs crossings = crossing_loops(loops);
  if (crossings.empty()) return {fill_even_odd(loops), 0};

  const Nesting nesting = nest(loops, crossings);
  std::vector<Region> solids;
  for (std::size_t outer = 0; outer < loops.size(); ++outer) {
    if (nesting.depth[outer] % 2 != 0) continue;
    std::vector<Loop> solid{loops[outer]};
    for (std::size_t hole = 0; hole < loops.size(); ++hole) {
      if (hole != outer && nesting.parent[hole] == outer) solid.push_back(loops[hole]);
    }
    solids.push_back(fill_even_odd(solid));
  }
  return {unite(solids), crossings.size()};
}

LayerRegion make_region(const engine::Layer& layer, const RegionOptions& options) {
  LayerRegion result;
  result.index = layer.index;
  result.plane = layer.plane;
  result.open_contours = layer.open.size();
  result.touch_points = layer.points.size();
  result.planar_contours = layer.planar.size();

  std::vector<Loop> loops;
  for (const engine::ClosedContour& contour : layer.closed) {
    if (contour.touch) {
      ++result.touch_contours;
    } else {
      loops.push_back(engine::flatten_balanced(contour.curve, options.tolerance));
    }
  }
  result.closed_contours = loops.size();

  FilledContours filled = fill_contours(loops);
  result.crossing_contours = filled.crossings;
  std::vector<Region> parts{std::move(filled.region)};
  for (const engine::PlanarContour& contour : layer.planar) {
    std::vector<Loop> face{engine::flatten_balanced(contour.outer, options.tolerance)};
    for (const engine::PieceCurve& inner : contour.inner) {
      face.push_back(engine::flatten_balanced(inner, options.tolerance));
    }
    parts.push_back(fill_even_odd(face));
  }
  result.region = parts.size() == 1 ? std::move(parts.front()) : unite(parts);
  const double growth = options.xy_compensation - (layer.index == 0 ? options.elephant_foot : 0.0);
  result.region = compensate(result.region, growth);
  return result;
}

}  // namespace lamina::gcode
