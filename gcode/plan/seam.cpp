#include "gcode/plan/seam.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace lamina::gcode {
namespace {

using engine::Loop;
using engine::Vector2;

constexpr double kSeamReach = 3.0;                      // mm
constexpr double kCornerTurn = std::numbers::pi / 6.0;  // 30 degrees

/// A choice needs a clear advantage to displace an earlier vertex, so that rounding does not move the seam.
constexpr double kClear = 1e-6;

template <typename Cost>
std::size_t cheapest(std::size_t count, Cost cost) {
  std::size_t best = 0;
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const double value = cost(i);
    if (value < lowest - kClear) {
      lowest = value;
      best = i;
    }
  }
  return best;
}

double turn_at(const Loop& loop, std::size_t i) {
  const Vector2 in = loop[i] - loop[(i + loop.size() - 1) % loop.size()];
  const Vector2 out = loop[(i + 1) % loop.size()] - loop[i];
  return std::abs(std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out)));
}

double distance_to_nearest(const Vector2& point, const std::vector<Vector2>& others) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vector2& other : others) nearest = std::min(nearest, (point - other).norm());
  return nearest;
}

}  // namespace

std::size_t seam_vertex(const Loop& loop, SeamPosition position, const Vector2& nozzle,
                        const std::vector<Vector2>& below) {
  if (position == SeamPosition::kNearest) {
    return cheapest(loop.size(), [&](std::size_t i) { return (loop[i] - nozzle).norm(); });
  }
  const std::size_t rear = cheapest(loop.size(), [&](std::size_t i) { return -loop[i].y(); });
  if (position == SeamPosition::kRear) return rear;

  const auto distance = [&](std::size_t i) { return distance_to_nearest(loop[i], below); };
  const std::size_t aligned = cheapest(loop.size(), distance);
  if (distance(aligned) <= kSeamReach) return aligned;
  const std::size_t sharpest = cheapest(loop.size(), [&](std::size_t i) { return -turn_at(loop, i); });
  return turn_at(loop, sharpest) > kCornerTurn ? sharpest : rear;
}

}  // namespace lamina::gcode
