#include "gcode/region/polygon_clipping.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <polyclipping/clipper.hpp>

namespace lamina::gcode {
namespace {

using engine::Loop;
using engine::Polygon;
using engine::Region;
using engine::Vector2;

constexpr double kUnitsPerMm = 1e6;
constexpr double kArcTolerance = 0.001;  // mm; Clipper rounds the number of chords, so half as much again
constexpr double kMiterLimit = 3.0;

ClipperLib::IntPoint to_lattice(const Vector2& p) {
  return {std::llround(p.x() * kUnitsPerMm), std::llround(p.y() * kUnitsPerMm)};
}

ClipperLib::Path to_path(const Loop& loop) {
  ClipperLib::Path path;
  path.reserve(loop.size());
  for (const Vector2& vertex : loop) path.push_back(to_lattice(vertex));
  return path;
}

ClipperLib::Paths to_paths(const Region& region) {
  ClipperLib::Paths paths;
  for (const Polygon& polygon : region) {
    paths.push_back(to_path(polygon.outer));
    for (const Loop& hole : polygon.holes) paths.push_back(to_path(hole));
  }
  return paths;
}

Loop to_loop(const ClipperLib::Path& path) {
  Loop loop;
  loop.reserve(path.size());
  for (const ClipperLib::IntPoint& p : path) {
    loop.emplace_back(static_cast<double>(p.X) / kUnitsPerMm, static_cast<double>(p.Y) / kUnitsPerMm);
  }
  return loop;
}

struct LatticeBox {
  ClipperLib::cInt left = 0, right = 0, low = 0, high = 0;

  bool contains(const LatticeBox& other) const {
    return left <= other.left && other.right <= right && low <= other.low && other.high <= high;
  }
};

LatticeBox box_of(const ClipperLib::Path& path) {
  LatticeBox box{path.front().X, path.front().X, path.front().Y, path.front().Y};
  for (const ClipperLib::IntPoint& p : path) {
    box.left = std::min(box.left, p.X);
    box.right = std::max(box.right, p.X);
    box.low = std::min(box.low, p.Y);
    box.high = std::max(box.high, p.Y);
  }
  return box;
}

/// Whether a loop lies in another that it does not cross; it may touch it.
bool lies_in(const ClipperLib::Path& inner, const ClipperLib::Path& outer) {
  for (const ClipperLib::IntPoint& p : inner) {
    const int answer = ClipperLib::PointInPolygon(p, outer);
    if (answer >= 0) return answer == 1;
  }
  return true;
}

/// Gives each hole to the smallest outer loop around it. Clipper's own tree does the same, but while it
/// clips, in quadratic time.
Region to_region(const ClipperLib::Paths& paths) {
  struct Outer {
    const ClipperLib::Path* path;
    LatticeBox box;
    double area;
  };
  Region region;
  std::vector<Outer> outers;
  for (const ClipperLib::Path& path : paths) {
    const double area = ClipperLib::Area(path);
    if (path.size() < 3 || area <= 0.0) continue;
    outers.push_back({&path, box_of(path), area});
    region.push_back({to_loop(path), {}});
  }
  for (const ClipperLib::Path& path : paths) {
    if (path.size() < 3 || ClipperLib::Area(path) >= 0.0) continue;
    const LatticeBox box = box_of(path);
    std::size_t owner = outers.size();
    for (std::size_t i = 0; i < outers.size(); ++i) {
      if (owner < outers.size() && outers[i].area >= outers[owner].area) continue;
      if (outers[i].box.contains(box) && lies_in(path, *outers[i].path)) owner = i;
    }
    if (owner < outers.size()) region[owner].holes.push_back(to_loop(path));
  }
  return region;
}

Region clip(ClipperLib::ClipType type, const ClipperLib::Paths& subject, const ClipperLib::Paths& clip,
            ClipperLib::PolyFillType fill) {
  ClipperLib::Clipper clipper;
  clipper.AddPaths(subject, ClipperLib::ptSubject, true);
  clipper.AddPaths(clip, ClipperLib::ptClip, true);
  ClipperLib::Paths result;
  clipper.Execute(type, result, fill, fill);
  return to_region(result);
}

}  // namespace

Region fill_even_odd(const std::vector<Loop>& loops) {
  ClipperLib::Paths paths;
  for (const Loop& loop : loops) paths.push_back(to_path(loop));
  return clip(ClipperLib::ctUnion, paths, {}, ClipperLib::pftEvenOdd);
}

Region unite(const std::vector<Region>& regions) {
  ClipperLib::Paths paths;
  for (const Region& region : regions) {
    const ClipperLib::Paths more = to_paths(region);
    paths.insert(paths.end(), more.begin(), more.end());
  }
  return clip(ClipperLib::ctUnion, paths, {}, ClipperLib::pftNonZero);
}

Region intersect(const Region& a, const Region& b) {
  if (a.empty() || b.empty()) return {};
  return clip(ClipperLib::ctIntersection, to_paths(a), to_paths(b), ClipperLib::pftNonZero);
}

Region subtract(const Region& from, const Region& removed) {
  if (from.empty() || removed.empty()) return from;
  return clip(ClipperLib::ctDifference, to_paths(from), to_paths(removed), ClipperLib::pftNonZero);
}

Region offset(const Region& region, double distance, Join join) {
  if (region.empty() || distance == 0.0) return region;
  ClipperLib::ClipperOffset clipper(kMiterLimit, kArcTolerance * kUnitsPerMm);
  clipper.AddPaths(to_paths(region), join == Join::kRound ? ClipperLib::jtRound : ClipperLib::jtMiter,
                   ClipperLib::etClosedPolygon);
  ClipperLib::Paths result;
  clipper.Execute(result, distance * kUnitsPerMm);
  return to_region(result);
}

Region opened(const Region& region, double radius) {
  const Region grown_back = offset(offset(region, -radius, Join::kRound), radius, Join::kMiter);
  // Where nothing but rounding was lost the region itself is the better answer.
  const double lost = engine::area(region) - engine::area(grown_back);
  if (std::abs(lost) < 1e-3 * radius * radius) return region;
  return intersect(grown_back, region);  // a miter may reach out where the region has a blunt tip
}

int side_of_loop(const Vector2& point, const Loop& loop) {
  const int answer = ClipperLib::PointInPolygon(to_lattice(point), to_path(loop));
  if (answer < 0) return 0;
  return answer == 1 ? 1 : -1;
}

}  // namespace lamina::gcode
