#include "engine/geometry/polygon.h"

#include <cmath>

namespace lamina::engine {

double signed_area(const Loop& loop) {
  double twice = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector2& a = loop[i];
    const Vector2& b = loop[(i + 1) % loop.size()];
    twice += a.x() * b.y() - b.x() * a.y();
  }
  return 0.5 * twice;
}

double length(const Polyline& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += (line[i] - line[i - 1]).norm();
  return sum;
}

double perimeter(const Loop& loop) {
  return loop.empty() ? 0.0 : length(loop) + (loop.front() - loop.back()).norm();
}

double area(const Region& region) {
  double sum = 0.0;
  for (const Polygon& polygon : region) {
    sum += std::abs(signed_area(polygon.outer));
    for (const Loop& hole : polygon.holes) sum -= std::abs(signed_area(hole));
  }
  return sum;
}

Box2 bounds(const Region& region) {
  Box2 box;
  for (const Polygon& polygon : region) {
    for (const Vector2& vertex : polygon.outer) box.extend(vertex);
  }
  return box;
}

}  // namespace lamina::engine
