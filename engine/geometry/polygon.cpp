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

bool contains(const Loop& loop, const Vector2& point) {
  bool inside = false;
  for (std::size_t i = 0, j = loop.size() - 1; i < loop.size(); j = i++) {
    const Vector2& a = loop[i];
    const Vector2& b = loop[j];
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y()) + a.x()) {
      inside = !inside;
    }
  }
  return inside;
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
