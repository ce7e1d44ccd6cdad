#include "engine/import/trim/winding_loops.h"

#include <algorithm>
#include <cmath>

#include "engine/nurbs/restrict.h"
#include "engine/nurbs/reverse.h"

namespace lamina::engine {
namespace {

/// A way once round the surface, in either direction, from one end of the domain to the other.
struct Round {
  std::vector<NurbsCurve> curves;
  bool is_forwards = true;  ///< in the direction of u
};

/// Parameter of a curve at which its u passes `u`; the ends are on either side.
double parameter_at(const NurbsCurve& curve, double u) {
  double low = curve.first_parameter();
  double high = curve.last_parameter();
  const bool rising = parameter_start(curve).x() < u;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    const bool is_before = (evaluate(curve, middle).x() < u) == rising;
    (is_before ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The loop cut where it passes the seam, moved into the domain.
Round round_from(const ParameterLoop& loop, double first_u, double period) {
  Round round;
  round.is_forwards = loop.turns_u > 0;
  const double start = parameter_start(loop.curves.front()).x();
  // The seam that lies on the way: at the start, or between start and end.
  constexpr double kRounding = 1e-9;
  double seam = first_u + period * std::ceil((start - first_u) / period - kRounding);
  if (!round.is_forwards) seam = first_u + period * std::floor((start - first_u) / period + kRounding);

  std::vector<NurbsCurve> before;
  std::vector<NurbsCurve> after;
  const bool starts_there = std::abs(start - seam) <= kRounding * period;
  for (const NurbsCurve& curve : loop.curves) {
    const double a = parameter_start(curve).x();
    const double b = parameter_end(curve).x();
    const bool passes = !starts_there && after.empty() && (a < seam) != (b < seam);
    if (!passes) {
      const bool is_after = starts_there || !after.empty();
      (is_after ? after : before).push_back(curve);
      continue;
    }
    const double t = parameter_at(curve, seam);
    const double margin = kRounding * (curve.last_parameter() - curve.first_parameter());
    if (t - curve.first_parameter() > margin) before.push_back(restricted(curve, curve.first_parameter(), t));
    if (curve.last_parameter() - t > margin) after.push_back(restricted(curve, t, curve.last_parameter()));
    if (after.empty())
      after.push_back(parameter_line({seam, parameter_end(curve).y()}, {seam, parameter_end(curve).y()}));
  }
  const double turn = round.is_forwards ? period : -period;
  const double origin = round.is_forwards ? first_u : first_u + period;
  for (const NurbsCurve& curve : after) round.curves.push_back(moved(curve, {origin - seam, 0.0}));
  for (const NurbsCurve& curve : before) round.curves.push_back(moved(curve, {origin - seam + turn, 0.0}));
  return round;
}

std::vector<NurbsCurve> backwards(const std::vector<NurbsCurve>& curves) {
  std::vector<NurbsCurve> result;
  for (auto curve = curves.rbegin(); curve != curves.rend(); ++curve) result.push_back(reversed(*curve));
  return result;
}

/// The band between two rounds, counter-clockwise.
ParameterLoop band(const Round& lower, const Round& upper) {
  ParameterLoop loop;
  loop.curves = lower.is_forwards ? lower.curves : backwards(lower.curves);
  const std::vector<NurbsCurve> back = upper.is_forwards ? backwards(upper.curves) : upper.curves;
  loop.curves.push_back(parameter_line(parameter_end(loop.curves.back()), parameter_start(back.front())));
  loop.curves.insert(loop.curves.end(), back.begin(), back.end());
  loop.curves.push_back(
      parameter_line(parameter_end(loop.curves.back()), parameter_start(loop.curves.front())));
  return loop;
}

}  // namespace

std::optional<std::vector<ParameterLoop>> without_turns_in_u(const NurbsSurface& surface,
                                                             const SurfaceTopology& topology,
                                                             std::vector<ParameterLoop> loops) {
  std::vector<ParameterLoop> result;
  std::vector<Round> rounds;
  for (ParameterLoop& loop : loops) {
    if (std::abs(loop.turns_u) > 1) return std::nullopt;
    if (loop.turns_u == 0) {
      result.push_back(std::move(loop));
    } else {
      rounds.push_back(round_from(loop, surface.first_u(), topology.period_u));
    }
  }
  const auto height = [](const Round& round) { return parameter_start(round.curves.front()).y(); };
  std::sort(rounds.begin(), rounds.end(),
            [&](const Round& a, const Round& b) { return height(a) < height(b); });
  if (topology.period_v > 0.0 && rounds.size() == 2 && !rounds[0].is_forwards && rounds[1].is_forwards) {
    // The band that goes on beyond the seam in v.
    for (NurbsCurve& curve : rounds[0].curves) curve = moved(std::move(curve), {0.0, topology.period_v});
    std::swap(rounds[0], rounds[1]);
  }
  const auto border = [&](double v) {
    return Round{{parameter_line({surface.first_u(), v}, {surface.last_u(), v})}, true};
  };
  const bool is_one_band = rounds.size() == 2 && rounds[0].is_forwards == rounds[1].is_forwards;
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    if (is_one_band || (rounds[i].is_forwards && i + 1 < rounds.size())) {
      result.push_back(band(rounds[i], rounds[i + 1]));
      ++i;
    } else if (rounds[i].is_forwards) {
      result.push_back(band(rounds[i], border(surface.last_v())));
    } else {
      result.push_back(band(border(surface.first_v()), rounds[i]));
    }
  }
  return result;
}

}  // namespace lamina::engine
