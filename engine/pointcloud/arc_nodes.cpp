#include "engine/pointcloud/arc_nodes.h"

#include <cmath>

namespace lamina::engine {
namespace {

constexpr int kDeepestBisection = 24;

}  // namespace

SectionArc ArcNodes::begin(ArcKind kind) const {
  return {static_cast<std::uint32_t>(section_.nodes.size()), 0, patch_.span.surface, kind};
}

void ArcNodes::finish(SectionArc& arc) const {
  arc.count = static_cast<std::uint32_t>(section_.nodes.size()) - arc.first;
}

SectionArc ArcNodes::crossing(const LineCrossing& solved, double from, const CrossingPoint& start, double to,
                              const CrossingPoint& end) {
  const bool curved = patch_.degree_u > 1 || patch_.degree_v > 1;
  SectionArc arc = begin(ArcKind::kCrossing);
  section_.nodes.push_back(start.node);
  bisect(solved, from, start, to, end, curved ? 1 : 0, 0);
  section_.nodes.push_back(end.node);
  finish(arc);
  return arc;
}

SectionArc ArcNodes::edge(Direction held, double at, double from, double to, ArcKind kind) {
  SectionArc arc = begin(kind);
  const EdgePoint start = point_on_line(patch_, held, at, from);
  const EdgePoint end = point_on_line(patch_, held, at, to);
  const int degree = held == Direction::kU ? patch_.degree_v : patch_.degree_u;
  arc.upright = start.upright() && end.upright();
  const double sign = to > from ? 1.0 : -1.0;
  section_.nodes.push_back(
      {start.position, sign * start.derivative.normalized(), parameters_on(held, at, from)});
  bisect(held, at, from, start, to, end, degree > 1 ? 1 : 0, 0);
  section_.nodes.push_back({end.position, sign * end.derivative.normalized(), parameters_on(held, at, to)});
  finish(arc);
  return arc;
}

bool ArcNodes::chord_holds(const Vector2& a, const Vector2& tangent_a, const Vector2& b,
                           const Vector2& tangent_b) const {
  const Vector2 chord = b - a;
  const double length_squared = chord.squaredNorm();
  if (length_squared <= 1e-2 * tolerance_ * tolerance_) return true;
  const auto sideways = [&](const Vector2& tangent) {
    return std::abs(chord.x() * tangent.y() - chord.y() * tangent.x());
  };
  if (!(chord.dot(tangent_a) > 0.0) || !(chord.dot(tangent_b) > 0.0)) {
    return length_squared <= tolerance_ * tolerance_;
  }
  // A cubic that leaves its chord of length L at the angles a and b is at most 4/27 L (tan a + tan b) from
  // it; a circle 1/8 of that product.
  return 0.15 * (sideways(tangent_a) + sideways(tangent_b)) <= tolerance_;
}

void ArcNodes::bisect(const LineCrossing& solved, double from, const CrossingPoint& start, double to,
                      const CrossingPoint& end, int forced, int depth) {
  if (depth == kDeepestBisection || (forced <= 0 && chord_holds(start.node.position, start.node.tangent,
                                                                end.node.position, end.node.tangent))) {
    return;
  }
  LineCrossing line = solved;
  line.at = 0.5 * (from + to);
  // The middle of the cubic with these ends and slopes.
  line.guess = 0.5 * (start.parameter + end.parameter) + 0.125 * (to - from) * (start.slope - end.slope);
  const CrossingPoint middle = crossing_on_line(patch_, z_, line);
  bisect(solved, from, start, line.at, middle, forced - 1, depth + 1);
  section_.nodes.push_back(middle.node);
  bisect(solved, line.at, middle, to, end, forced - 1, depth + 1);
}

void ArcNodes::bisect(Direction held, double at, double from, const EdgePoint& start, double to,
                      const EdgePoint& end, int forced, int depth) {
  const double sign = to > from ? 1.0 : -1.0;
  if (depth == kDeepestBisection ||
      (forced <= 0 && chord_holds(start.position, sign * start.derivative.normalized(), end.position,
                                  sign * end.derivative.normalized()))) {
    return;
  }
  const double middle = 0.5 * (from + to);
  const EdgePoint point = point_on_line(patch_, held, at, middle);
  bisect(held, at, from, start, middle, point, forced - 1, depth + 1);
  section_.nodes.push_back(
      {point.position, sign * point.derivative.normalized(), parameters_on(held, at, middle)});
  bisect(held, at, middle, point, to, end, forced - 1, depth + 1);
}

}  // namespace lamina::engine
