#include "gcode/plan/simplify.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace lamina::gcode {
namespace {

using engine::Loop;
using engine::Polyline;
using engine::Vector2;

double distance_to_segment(const Vector2& p, const Vector2& a, const Vector2& b) {
  const Vector2 side = b - a;
  const double squared = side.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((p - a).dot(side) / squared, 0.0, 1.0) : 0.0;
  return (p - a - t * side).norm();
}

}  // namespace

Polyline simplified(const Polyline& line, double tolerance) {
  if (line.size() < 3) return line;
  std::vector<bool> kept(line.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> spans{{0, line.size() - 1}};
  while (!spans.empty()) {
    const auto [first, last] = spans.back();
    spans.pop_back();
    double worst = tolerance;
    std::size_t farthest = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double distance = distance_to_segment(line[i], line[first], line[last]);
      if (distance > worst) {
        worst = distance;
        farthest = i;
      }
    }
    if (farthest == first) continue;
    kept[farthest] = true;
    spans.emplace_back(first, farthest);
    spans.emplace_back(farthest, last);
  }
  Polyline result;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (kept[i]) result.push_back(line[i]);
  }
  return result;
}

Loop simplified_loop(const Loop& loop, double tolerance) {
  if (loop.size() < 4) return loop;
  const auto farthest = std::max_element(loop.begin(), loop.end(), [&](const Vector2& a, const Vector2& b) {
    return (a - loop.front()).squaredNorm() < (b - loop.front()).squaredNorm();
  });
  Polyline there(loop.begin(), farthest + 1);
  Polyline back(farthest, loop.end());
  back.push_back(loop.front());
  there = simplified(there, tolerance);
  back = simplified(back, tolerance);
  there.insert(there.end(), back.begin() + 1, back.end() - 1);
  return there.size() < 3 ? loop : there;
}

}  // namespace lamina::gcode
