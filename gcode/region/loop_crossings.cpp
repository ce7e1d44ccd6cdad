#include "gcode/region/loop_crossings.h"

#include <algorithm>
#include <set>

#include "engine/geometry/vector.h"

namespace lamina::gcode {
namespace {

using engine::Loop;
using engine::Vector2;

struct Side {
  Vector2 a;
  Vector2 b;
  std::size_t loop = 0;

  double low() const { return std::min(a.y(), b.y()); }
  double high() const { return std::max(a.y(), b.y()); }
  double left() const { return std::min(a.x(), b.x()); }
  double right() const { return std::max(a.x(), b.x()); }
};

double turn(const Vector2& a, const Vector2& b, const Vector2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool cross(const Side& s, const Side& t) {
  if (s.left() > t.right() || t.left() > s.right()) return false;
  return turn(s.a, s.b, t.a) * turn(s.a, s.b, t.b) < 0.0 && turn(t.a, t.b, s.a) * turn(t.a, t.b, s.b) < 0.0;
}

std::vector<Side> sides_by_height(const std::vector<Loop>& loops) {
  std::vector<Side> sides;
  for (std::size_t loop = 0; loop < loops.size(); ++loop) {
    const Loop& vertices = loops[loop];
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      sides.push_back({vertices[i], vertices[(i + 1) % vertices.size()], loop});
    }
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const Side& s, const Side& t) { return s.low() < t.low(); });
  return sides;
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> crossing_loops(const std::vector<Loop>& loops) {
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  std::vector<Side> open;
  for (const Side& side : sides_by_height(loops)) {
    std::erase_if(open, [&](const Side& other) { return other.high() < side.low(); });
    for (const Side& other : open) {
      if (other.loop != side.loop && cross(side, other)) pairs.insert(std::minmax(side.loop, other.loop));
    }
    open.push_back(side);
  }
  return {pairs.begin(), pairs.end()};
}

}  // namespace lamina::gcode
