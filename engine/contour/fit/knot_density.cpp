#include "engine/contour/fit/knot_density.h"

#include <cassert>

namespace lamina::engine {

KnotDensity::KnotDensity(const std::vector<double>& breaks, const std::vector<double>& masses)
    : breaks_(breaks) {
  assert(breaks.size() == masses.size() + 1);
  sums_.reserve(breaks.size());
  sums_.push_back(0.0);
  for (const double mass : masses) sums_.push_back(sums_.back() + mass);
}

Knots KnotDensity::knots(int degree, std::size_t spans) const {
  const auto ends = static_cast<std::size_t>(degree) + 1;
  Knots knots(ends, breaks_.front());
  knots.reserve(2 * ends + spans - 1);
  std::size_t piece = 0;
  for (std::size_t i = 1; i < spans; ++i) {
    const double mass = sums_.back() * static_cast<double>(i) / static_cast<double>(spans);
    while (piece + 2 < sums_.size() && sums_[piece + 1] <= mass) ++piece;
    const double share = (mass - sums_[piece]) / (sums_[piece + 1] - sums_[piece]);
    knots.push_back(breaks_[piece] + share * (breaks_[piece + 1] - breaks_[piece]));
  }
  knots.insert(knots.end(), ends, breaks_.back());
  return knots;
}

}  // namespace lamina::engine
