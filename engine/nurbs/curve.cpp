#include "engine/nurbs/curve.h"

namespace lamina::engine {

Vector3 evaluate(const NurbsCurve& curve, double t) {
  const std::size_t span = find_span(curve.knots, curve.degree, t);
  const BasisRow basis = basis_functions(curve.knots, curve.degree, span, t);
  Vector4 sum = Vector4::Zero();
  for (std::size_t r = 0; r < basis.size(); ++r) {
    sum += basis[r] * curve.control_points[span - static_cast<std::size_t>(curve.degree) + r];
  }
  return cartesian(sum);
}

CurveDerivative evaluate_derivative(const NurbsCurve& curve, double t) {
  const std::size_t span = find_span(curve.knots, curve.degree, t);
  const auto basis = basis_derivatives(curve.knots, curve.degree, span, t);
  Vector4 sum = Vector4::Zero();
  Vector4 change = Vector4::Zero();
  for (std::size_t r = 0; r < basis[0].size(); ++r) {
    const Vector4& point = curve.control_points[span - static_cast<std::size_t>(curve.degree) + r];
    sum += basis[0][r] * point;
    change += basis[1][r] * point;
  }
  const Vector3 point = cartesian(sum);
  return {point, (change.head<3>() - change.w() * point) / sum.w()};
}

}  // namespace lamina::engine
