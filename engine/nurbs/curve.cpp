#include "engine/nurbs/curve.h"

namespace lamina::engine {

Vector3 evaluate(const NurbsCurve& curve, double t) {
  const std::size_t span = find_span(curve.knots, curve.degree, t);
  const std::vector<double> basis = basis_functions(curve.knots, curve.degree, span, t);
  Vector4 sum = Vector4::Zero();
  for (std::size_t r = 0; r < basis.size(); ++r) {
    sum += basis[r] * curve.control_points[span - static_cast<std::size_t>(curve.degree) + r];
  }
  return cartesian(sum);
}

}  // namespace lamina::engine
