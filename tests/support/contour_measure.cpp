#include "tests/support/contour_measure.h"

#include <algorithm>
#include <cmath>

namespace lamina::tests {
namespace {

using engine::Loop;
using engine::Vector2;

/// Whether a ray from the point crosses the loop an odd number of times.
bool encloses(const Loop& loop, const Vector2& point) {
  bool inside = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector2& a = loop[i];
    const Vector2& b = loop[(i + 1) % loop.size()];
    if ((a.y() > point.y()) == (b.y() > point.y())) continue;
    if (point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

}  // namespace

double parity_area(const std::vector<Loop>& loops) {
  double sum = 0.0;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    bool filled = true;
    for (std::size_t j = 0; j < loops.size(); ++j) {
      if (j != i && encloses(loops[j], loops[i].front())) filled = !filled;
    }
    sum += (filled ? 1.0 : -1.0) * std::abs(engine::signed_area(loops[i]));
  }
  return sum;
}

std::vector<Loop> closed_loops(const engine::Layer& layer, double tolerance) {
  std::vector<Loop> loops;
  for (const engine::ClosedContour& contour : layer.closed) {
    loops.push_back(engine::flatten(contour.curve, tolerance));
  }
  return loops;
}

double perimeter_of(const std::vector<Loop>& loops) {
  double sum = 0.0;
  for (const Loop& loop : loops) sum += engine::perimeter(loop);
  return sum;
}

double greatest_distance_from(const Section& section, const std::vector<Loop>& loops) {
  double greatest = 0.0;
  for (const Loop& loop : loops) {
    for (const Vector2& point : loop) greatest = std::max(greatest, section.distance(point));
  }
  return greatest;
}

double greatest_distance_to(const Section& section, const std::vector<Loop>& loops, double step) {
  const Section chains = polyline_section(loops);
  double greatest = 0.0;
  for (const Vector2& point : section.points(step)) greatest = std::max(greatest, chains.distance(point));
  return greatest;
}

}  // namespace lamina::tests
