#pragma once

#include <vector>

#include "engine/geometry/bspline_basis.h"

namespace lamina::engine {

/// How dense the knots of a spline should lie: piecewise constant over its domain.
class KnotDensity {
 public:
  /// `masses[i]` (not negative, not all zero) between `breaks[i]` and `breaks[i + 1]`, ascending.
  KnotDensity(const std::vector<double>& breaks, const std::vector<double>& masses);

  /// A clamped knot vector with `spans` spans of equal mass.
  Knots knots(int degree, std::size_t spans) const;

 private:
  std::vector<double> breaks_;
  std::vector<double> sums_;  // mass up to each break
};

}  // namespace lamina::engine
