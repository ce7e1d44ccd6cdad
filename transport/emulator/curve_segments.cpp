#include "transport/emulator/curve_segments.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lamina::transport {

namespace {

/// Of an arc that is larger than any printer: it is not followed more finely.
constexpr double kMostChords = 1e6;
constexpr double kMinChord = 0.1;  // mm
constexpr double kMaxChord = 1.0;  // mm
constexpr double kMinChordsOfCircle = 72;
constexpr double kMinStep = 0.002;        // of the Bezier parameter
constexpr double kMaxStep = 0.1;          // of the Bezier parameter
constexpr double kBezierDeviation = 0.1;  // mm
constexpr double kFullTurn = 2 * std::numbers::pi;

double bezier(double p0, double p1, double p2, double p3, double t) {
  const double s = 1 - t;
  return s * s * s * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t * t * t * p3;
}

double between(double a, double b, double t) {
  return a + (b - a) * t;
}

struct Point {
  double x = 0, y = 0;
};

}  // namespace

std::optional<Arc> arc_by_center(const MachinePosition& start, std::optional<double> i,
                                 std::optional<double> j, bool clockwise, int extra_turns) {
  if (i.value_or(0) == 0 && j.value_or(0) == 0) return std::nullopt;
  return Arc{start[0] + i.value_or(0), start[1] + j.value_or(0), clockwise, extra_turns};
}

std::optional<Arc> arc_by_radius(const MachinePosition& start, const MachinePosition& end, double radius,
                                 bool clockwise) {
  const double dx = end[0] - start[0];
  const double dy = end[1] - start[1];
  const double chord = std::hypot(dx, dy);
  const double height_squared = radius * radius - chord * chord / 4;
  if (radius == 0 || chord == 0) return std::nullopt;
  // The center lies beside the chord's middle: to its right for the shorter clockwise arc.
  const double side = clockwise == (radius > 0) ? 1 : -1;
  const double height = height_squared > 0 ? side * std::sqrt(height_squared) : 0;
  return Arc{(start[0] + end[0]) / 2 + dy / chord * height, (start[1] + end[1]) / 2 - dx / chord * height,
             clockwise, 0};
}

std::vector<MachinePosition> arc_segments(const MachinePosition& start, const MachinePosition& end,
                                          const Arc& arc) {
  const double from_x = start[0] - arc.center_x;
  const double from_y = start[1] - arc.center_y;
  const double to_x = end[0] - arc.center_x;
  const double to_y = end[1] - arc.center_y;
  const double radius = std::hypot(from_x, from_y);

  double turn = 0;
  if (std::abs(start[0] - end[0]) < 1e-6 && std::abs(start[1] - end[1]) < 1e-6) {
    turn = arc.clockwise ? -kFullTurn : kFullTurn;
  } else {
    turn = std::atan2(from_x * to_y - from_y * to_x, from_x * to_x + from_y * to_y);
    if (arc.clockwise && turn > 0) turn -= kFullTurn;
    if (!arc.clockwise && turn < 0) turn += kFullTurn;
  }
  turn += (arc.clockwise ? -kFullTurn : kFullTurn) * arc.extra_turns;

  const double length = radius * std::abs(turn);
  const double at_least = std::ceil(kMinChordsOfCircle * std::abs(turn) / kFullTurn - 1e-9);
  double count = std::max(std::floor(length / kMaxChord), at_least);
  if (length / count > kMaxChord) count = std::ceil(length / kMaxChord);
  if (length / count < kMinChord) count = std::max(1.0, std::floor(length / kMinChord));
  count = std::min(count, kMostChords);

  std::vector<MachinePosition> points;
  const auto chords = static_cast<int>(count);
  for (int i = 1; i < chords; ++i) {
    const double part = i / count;
    const double cosine = std::cos(turn * part);
    const double sine = std::sin(turn * part);
    points.push_back({arc.center_x + from_x * cosine - from_y * sine,
                      arc.center_y + from_x * sine + from_y * cosine, between(start[2], end[2], part),
                      between(start[3], end[3], part)});
  }
  points.push_back(end);
  return points;
}

std::vector<MachinePosition> bezier_segments(const MachinePosition& start, double first_x, double first_y,
                                             double second_x, double second_y, const MachinePosition& end) {
  const auto curve = [&](double t) {
    return Point{bezier(start[0], first_x, second_x, end[0], t),
                 bezier(start[1], first_y, second_y, end[1], t)};
  };
  /// Whether the chord from `a` to `b` may stand for the curve through `middle`.
  const auto close = [](Point a, Point b, Point middle) {
    return std::abs(middle.x - (a.x + b.x) / 2) + std::abs(middle.y - (a.y + b.y) / 2) <= kBezierDeviation;
  };
  std::vector<MachinePosition> points;
  Point at{start[0], start[1]};
  double t = 0;
  double step = kMaxStep;
  while (t < 1) {
    double next = std::min(t + step, 1.0);
    bool reduced = false;
    while (next - t >= kMinStep && !close(at, curve(next), curve((t + next) / 2))) {
      next = (t + next) / 2;
      reduced = true;
    }
    while (!reduced && next - t <= kMaxStep) {
      const double doubled = t + 2 * (next - t);
      if (doubled >= 1 || !close(at, curve(doubled), curve(next))) break;
      next = doubled;
    }
    step = next - t;
    t = next;
    at = curve(t);
    points.push_back({at.x, at.y, between(start[2], end[2], t), between(start[3], end[3], t)});
  }
  points.back() = end;
  return points;
}

}  // namespace lamina::transport
