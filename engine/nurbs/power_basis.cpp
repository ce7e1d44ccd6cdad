#include "engine/nurbs/power_basis.h"

#include <cassert>

namespace lamina::engine {

std::vector<Vector3> bezier_from_power(const std::vector<Vector3>& coefficients, double length) {
  assert(!coefficients.empty());
  std::vector<Vector3> scaled = coefficients;  // for the parameter s / length
  double power = 1.0;
  for (Vector3& coefficient : scaled) {
    coefficient *= power;
    power *= length;
  }
  // Point i is the sum over k of C(i, k) / C(p, k) scaled[k].
  const auto p = static_cast<double>(coefficients.size() - 1);
  std::vector<Vector3> points;
  points.reserve(scaled.size());
  for (std::size_t i = 0; i < scaled.size(); ++i) {
    Vector3 point = Vector3::Zero();
    double ratio = 1.0;
    for (std::size_t k = 0; k <= i; ++k) {
      point += ratio * scaled[k];
      if (k < i) ratio *= static_cast<double>(i - k) / (p - static_cast<double>(k));
    }
    points.push_back(point);
  }
  return points;
}

}  // namespace lamina::engine
