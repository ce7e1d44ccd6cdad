#include "engine/geometry/arc_length.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lamina::engine {
namespace {

/// Length between two places without a knot in between: Gauss-Legendre with three points.
double length_between(const CurvePiece& piece, double begin, double end) {
  constexpr double kOuter = 0.774596669241483377035853079956;
  const double middle = 0.5 * (begin + end);
  const double half = 0.5 * (end - begin);
  const auto speed = [&](double u) { return point_and_derivative(piece, u).derivative.norm(); };
  return half / 9.0 *
         (5.0 * speed(middle - half * kOuter) + 8.0 * speed(middle) + 5.0 * speed(middle + half * kOuter));
}

}  // namespace

std::vector<double> even_places(const CurvePiece& piece, std::size_t parts) {
  std::vector<double> places{0.0};
  if (const auto* curve = std::get_if<PlanarCurve>(&piece)) {
    const std::vector<double> breaks = break_points(curve->knots, curve->degree);
    const double width = breaks.back() - breaks.front();
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      for (std::size_t k = 1; k <= parts; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(parts);
        places.push_back((breaks[i] - breaks.front() + share * (breaks[i + 1] - breaks[i])) / width);
      }
    }
    places.back() = 1.0;
  } else {
    places.push_back(1.0);
  }
  return places;
}

ArcLengthTable::ArcLengthTable(const CurvePiece& piece)
    : piece_(piece), places_(even_places(piece, 16)), walked_{0.0} {
  for (std::size_t i = 1; i < places_.size(); ++i) {
    walked_.push_back(walked_.back() + length_between(piece, places_[i - 1], places_[i]));
  }
}

double ArcLengthTable::place_at(double distance) const {
  const auto above = std::upper_bound(walked_.begin() + 1, walked_.end() - 1, distance);
  const auto cell = static_cast<std::size_t>(above - walked_.begin()) - 1;
  const double rest = distance - walked_[cell];
  const double width = places_[cell + 1] - places_[cell];
  double u = places_[cell] + width * std::clamp(rest / (walked_[cell + 1] - walked_[cell]), 0.0, 1.0);
  for (int newton = 0; newton < 3; ++newton) {
    const double speed = point_and_derivative(piece_, u).derivative.norm();
    if (speed <= 0.0) break;
    const double step = (length_between(piece_, places_[cell], u) - rest) / speed;
    u = std::clamp(u - step, places_[cell], places_[cell + 1]);
    if (std::abs(step) * speed <= 1e-9 * length()) break;
  }
  return u;
}

}  // namespace lamina::engine
