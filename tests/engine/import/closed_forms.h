#pragma once

#include <vector>

#include "engine/geometry/vector.h"
#include "engine/nurbs/curve.h"
#include "engine/nurbs/surface.h"

namespace lamina::tests {

/// B-spline basis function i of degree p, by the recursive definition (Cox, de Boor), 0 / 0 taken as 0.
/// Half-open spans: not for t at the upper end.
inline double basis_by_recursion(const std::vector<double>& knots, std::size_t i, int p, double t) {
  if (p == 0) return knots[i] <= t && t < knots[i + 1] ? 1.0 : 0.0;
  const auto q = static_cast<std::size_t>(p);
  const double low = knots[i + q] - knots[i];
  const double high = knots[i + q + 1] - knots[i + 1];
  double value = 0.0;
  if (low > 0.0) value += (t - knots[i]) / low * basis_by_recursion(knots, i, p - 1, t);
  if (high > 0.0) value += (knots[i + q + 1] - t) / high * basis_by_recursion(knots, i + 1, p - 1, t);
  return value;
}

/// Control points of a test curve with their weights.
struct WeightedPoint {
  engine::Vector3 point;
  double weight = 1.0;
};

/// Point of a rational B-spline curve straight from its definition.
inline engine::Vector3 curve_by_definition(const std::vector<double>& knots, int degree,
                                           const std::vector<WeightedPoint>& points, double t) {
  engine::Vector3 sum = engine::Vector3::Zero();
  double weight = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double basis = basis_by_recursion(knots, i, degree, t) * points[i].weight;
    sum += basis * points[i].point;
    weight += basis;
  }
  return sum / weight;
}

/// Parameters that cut [first, last] in `count` equal steps, both ends included.
inline std::vector<double> steps(double first, double last, int count) {
  std::vector<double> values;
  for (int i = 0; i <= count; ++i) values.push_back(first + (last - first) * i / count);
  return values;
}

}  // namespace lamina::tests
