#include "transport/session/curve_chords.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lamina::transport {

namespace {

constexpr double kSamePoint = 1e-6;  // mm
constexpr double kMostChords = 10'000;

double length(const PlanePoint& v) {
  return std::hypot(v[0], v[1]);
}
PlanePoint minus(const PlanePoint& a, const PlanePoint& b) {
  return {a[0] - b[0], a[1] - b[1]};
}

int chord_count(double exact) {
  return static_cast<int>(std::clamp(std::ceil(exact), 1.0, kMostChords));
}

}  // namespace

std::optional<ArcWay> arc_by_offset(const PlanePoint& start, const PlanePoint& end, const PlanePoint& offset,
                                    bool clockwise) {
  if (length(offset) < kSamePoint) return std::nullopt;
  ArcWay arc{start, end, {start[0] + offset[0], start[1] + offset[1]}, 0};
  const PlanePoint from = minus(start, arc.center);
  const PlanePoint to = minus(end, arc.center);
  arc.sweep = std::atan2(from[0] * to[1] - from[1] * to[0], from[0] * to[0] + from[1] * to[1]);
  constexpr double kTurn = 2 * std::numbers::pi;
  const bool full = length(minus(end, start)) < kSamePoint;
  if (full) arc.sweep = 0;
  if (clockwise && (arc.sweep > 0 || full)) arc.sweep -= kTurn;
  if (!clockwise && (arc.sweep < 0 || full)) arc.sweep += kTurn;
  return arc;
}

std::optional<ArcWay> arc_of_radius(const PlanePoint& start, const PlanePoint& end, double radius,
                                    bool clockwise) {
  const PlanePoint way = minus(end, start);
  const double half = length(way) / 2;
  if (half < kSamePoint || radius == 0) return std::nullopt;
  // A radius a hair too small, as rounding makes it, is a half circle.
  const double height = std::sqrt(std::max(0.0, radius * radius - half * half));
  if (half > std::abs(radius) * 1.001) return std::nullopt;
  const double side = (clockwise != (radius < 0)) ? -1 : 1;
  const PlanePoint offset{way[0] / 2 - side * height * way[1] / (2 * half),
                          way[1] / 2 + side * height * way[0] / (2 * half)};
  return arc_by_offset(start, end, offset, clockwise);
}

std::vector<PlanePoint> chords(const ArcWay& arc, double tolerance) {
  const PlanePoint from = minus(arc.start, arc.center);
  const double radius = length(from);
  // Sagitta: tolerance = r (1 - cos(step / 2)).
  const double step = 2 * std::acos(std::clamp(1 - tolerance / radius, -1.0, 1.0));
  const int count = chord_count(std::abs(arc.sweep) / step);
  std::vector<PlanePoint> ends;
  for (int i = 1; i < count; ++i) {
    const double angle = arc.sweep * i / count;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    ends.push_back({arc.center[0] + c * from[0] - s * from[1], arc.center[1] + s * from[0] + c * from[1]});
  }
  ends.push_back(arc.end);
  return ends;
}

std::vector<PlanePoint> chords(const std::array<PlanePoint, 4>& bezier, double tolerance) {
  const auto bend = [&](std::size_t at) {
    return length({bezier[at][0] - 2 * bezier[at + 1][0] + bezier[at + 2][0],
                   bezier[at][1] - 2 * bezier[at + 1][1] + bezier[at + 2][1]});
  };
  const double most_bent = 6 * std::max(bend(0), bend(1));
  const int count = chord_count(std::sqrt(most_bent / (8 * tolerance)));
  std::vector<PlanePoint> ends;
  for (int i = 1; i < count; ++i) {
    const double t = static_cast<double>(i) / count;
    const double u = 1 - t;
    PlanePoint point{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
      point[axis] = u * u * u * bezier[0][axis] + 3 * u * u * t * bezier[1][axis] +
                    3 * u * t * t * bezier[2][axis] + t * t * t * bezier[3][axis];
    }
    ends.push_back(point);
  }
  ends.push_back(bezier[3]);
  return ends;
}

}  // namespace lamina::transport
