#include "engine/import/trim/axis_map.h"

#include <algorithm>
#include <cmath>

namespace lamina::engine {

AxisMap::AxisMap(const Knots& knots, int degree, const std::vector<double>& weights) {
  constexpr int kArcDegree = 2;
  const std::vector<double> breaks = break_points(knots, degree);
  if (degree != kArcDegree || weights.size() != 2 * breaks.size() - 1) return;
  bool has_arc = false;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double cosine = weights[2 * i + 1] / std::sqrt(weights[2 * i] * weights[2 * i + 2]);
    const double half_angle = cosine < 1.0 - 1e-12 ? std::acos(std::max(cosine, -1.0)) : 0.0;
    has_arc = has_arc || half_angle > 0.0;
    spans_.push_back({breaks[i], breaks[i + 1], half_angle});
  }
  if (!has_arc) spans_.clear();
}

/// In the middle of an arc both are the same; an angle f from there is where tan(f / 2) says (the arc is a
/// stereographic projection of its parameter).
double AxisMap::operator()(double parameter) const {
  if (spans_.empty()) return parameter;
  const double first = spans_.front().first;
  const double range = spans_.back().last - first;
  // Angles may go on beyond a full turn.
  const double turns =
      parameter < first || parameter > first + range ? std::floor((parameter - first) / range) : 0.0;
  const double inside = parameter - turns * range;
  const auto after =
      std::find_if(spans_.begin(), spans_.end() - 1, [&](const Span& s) { return inside <= s.last; });
  const Span& span = *after;
  if (span.half_angle == 0.0) return parameter;
  const double middle = 0.5 * (span.first + span.last);
  const double half = 0.5 * (span.last - span.first);
  const double angle = (inside - middle) / half * span.half_angle;
  return turns * range + middle + half * std::tan(0.5 * angle) / std::tan(0.5 * span.half_angle);
}

AxisMap angle_map_u(const NurbsSurface& s) {
  std::vector<double> weights;
  for (std::size_t i = 0; i < s.net.count_u; ++i) weights.push_back(s.net.at(i, 0).w());
  return {s.knots_u, s.degree_u, weights};
}

AxisMap angle_map_v(const NurbsSurface& s) {
  std::vector<double> weights;
  for (std::size_t j = 0; j < s.net.count_v; ++j) weights.push_back(s.net.at(0, j).w());
  return {s.knots_v, s.degree_v, weights};
}

}  // namespace lamina::engine
