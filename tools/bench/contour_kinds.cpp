#include "tools/bench/contour_kinds.h"

#include <algorithm>

#include <fmt/format.h>

namespace lamina::tools {
namespace {

/// Contours do not cross: all of a loop lies in another or nothing of it. But where they touch, a corner may
/// seem to lie beyond the other's chords, so that most of its points decide.
bool lies_in(const engine::Loop& loop, const engine::Loop& around) {
  const auto inside = std::count_if(loop.begin(), loop.end(), [&](const engine::Vector2& point) {
    return engine::contains(around, point);
  });
  return 2 * static_cast<std::size_t>(inside) > loop.size();
}

std::vector<std::size_t> nesting_depths(const std::vector<engine::Loop>& loops) {
  std::vector<std::size_t> depths;
  for (const engine::Loop& loop : loops) {
    depths.push_back(
        static_cast<std::size_t>(std::count_if(loops.begin(), loops.end(), [&](const engine::Loop& around) {
          return &around != &loop && lies_in(loop, around);
        })));
  }
  std::sort(depths.begin(), depths.end());
  return depths;
}

}  // namespace

std::vector<engine::Loop> closed_loops(const engine::Layer& layer, double tolerance) {
  std::vector<engine::Loop> loops;
  for (const engine::ClosedContour& contour : layer.closed) {
    if (!contour.touch) loops.push_back(engine::flatten(contour.curve, tolerance));
  }
  std::erase_if(loops, [](const engine::Loop& loop) { return loop.empty(); });
  return loops;
}

ContourKinds kinds_of(const engine::Layer& layer, double tolerance) {
  ContourKinds kinds;
  for (const engine::ClosedContour& contour : layer.closed) kinds.touching += contour.touch ? 1 : 0;
  for (const engine::OpenContour& contour : layer.open) ++(contour.touch ? kinds.touching : kinds.open);
  kinds.planar = layer.planar.size();
  for (const engine::PlanarContour& contour : layer.planar) kinds.holes += contour.inner.size();
  kinds.points = layer.points.size();
  kinds.depths = nesting_depths(closed_loops(layer, tolerance));
  return kinds;
}

ContourKinds kinds_of(const engine::Region& region) {
  std::vector<engine::Loop> loops;
  for (const engine::Polygon& polygon : region) {
    loops.push_back(polygon.outer);
    loops.insert(loops.end(), polygon.holes.begin(), polygon.holes.end());
  }
  ContourKinds kinds;
  kinds.depths = nesting_depths(loops);
  return kinds;
}

std::string described(const ContourKinds& kinds) {
  std::string text = fmt::format("{} closed at depths", kinds.depths.size());
  for (const std::size_t depth : kinds.depths) text += fmt::format(" {}", depth);
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) text += fmt::format(", {} {}", count, what);
  };
  add(kinds.touching, "touch curves");
  add(kinds.open, "open");
  add(kinds.planar, "planar");
  add(kinds.holes, "planar holes");
  add(kinds.points, "points");
  return text;
}

}  // namespace lamina::tools
