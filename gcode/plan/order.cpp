#include "gcode/plan/order.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace lamina::gcode {
namespace {

double distance_to_island(const Island& island, const engine::Vector2& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::vector<BeadPath>& group : island.groups) {
    for (const BeadPath& path : group) nearest = std::min(nearest, distance_to_start(path, point));
    if (!group.empty()) break;
  }
  return nearest;
}

template <typename Items, typename Distance>
std::size_t nearest(const Items& items, Distance distance) {
  assert(!items.empty());
  std::size_t best = 0;
  double lowest = distance(items.front());
  for (std::size_t i = 1; i < items.size(); ++i) {
    const double value = distance(items[i]);
    if (value < lowest) {
      lowest = value;
      best = i;
    }
  }
  return best;
}

}  // namespace

double distance_to_start(const BeadPath& path, const engine::Vector2& point) {
  double nearest = std::min((path.points.front() - point).norm(), (path.points.back() - point).norm());
  if (!path.closed) return nearest;
  for (const engine::Vector2& vertex : path.points) nearest = std::min(nearest, (vertex - point).norm());
  return nearest;
}

std::size_t nearest_path(const std::vector<BeadPath>& paths, const engine::Vector2& point) {
  return nearest(paths, [&](const BeadPath& path) { return distance_to_start(path, point); });
}

std::size_t nearest_island(const std::vector<Island>& islands, const engine::Vector2& point) {
  return nearest(islands, [&](const Island& island) { return distance_to_island(island, point); });
}

}  // namespace lamina::gcode
