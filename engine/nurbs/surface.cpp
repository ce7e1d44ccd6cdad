#include "engine/nurbs/surface.h"

#include <array>

namespace lamina::engine {
namespace {

/// Homogeneous derivatives up to the second: entry [k][l] is the k-th in u and l-th in v, k + l <= 2 (The
/// NURBS Book, A3.6).
std::array<std::array<Vector4, 3>, 3> homogeneous_derivatives(const NurbsSurface& surface, double u,
                                                              double v) {
  const std::size_t span_u = find_span(surface.knots_u, surface.degree_u, u);
  const std::size_t span_v = find_span(surface.knots_v, surface.degree_v, v);
  const auto basis_u = basis_derivatives(surface.knots_u, surface.degree_u, span_u, u);
  const auto basis_v = basis_derivatives(surface.knots_v, surface.degree_v, span_v, v);
  const std::size_t first_u = span_u - static_cast<std::size_t>(surface.degree_u);
  const std::size_t first_v = span_v - static_cast<std::size_t>(surface.degree_v);
  std::array<std::array<Vector4, 3>, 3> derivatives;
  for (auto& row : derivatives) row.fill(Vector4::Zero());
  for (std::size_t i = 0; i < basis_u[0].size(); ++i) {
    std::array<Vector4, 3> row{Vector4::Zero(), Vector4::Zero(), Vector4::Zero()};
    for (std::size_t j = 0; j < basis_v[0].size(); ++j) {
      const Vector4& point = surface.net.at(first_u + i, first_v + j);
      for (std::size_t l = 0; l < 3; ++l) row[l] += basis_v[l][j] * point;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t l = 0; k + l < 3; ++l) derivatives[k][l] += basis_u[k][i] * row[l];
    }
  }
  return derivatives;
}

}  // namespace

Vector3 evaluate(const NurbsSurface& surface, double u, double v) {
  const std::size_t span_u = find_span(surface.knots_u, surface.degree_u, u);
  const std::size_t span_v = find_span(surface.knots_v, surface.degree_v, v);
  const BasisRow basis_u = basis_functions(surface.knots_u, surface.degree_u, span_u, u);
  const BasisRow basis_v = basis_functions(surface.knots_v, surface.degree_v, span_v, v);
  const std::size_t first_u = span_u - static_cast<std::size_t>(surface.degree_u);
  const std::size_t first_v = span_v - static_cast<std::size_t>(surface.degree_v);
  Vector4 sum = Vector4::Zero();
  for (std::size_t i = 0; i < basis_u.size(); ++i) {
    Vector4 row = Vector4::Zero();
    for (std::size_t j = 0; j < basis_v.size(); ++j)
      row += basis_v[j] * surface.net.at(first_u + i, first_v + j);
    sum += basis_u[i] * row;
  }
  return cartesian(sum);
}

SurfaceDerivatives evaluate_derivatives(const NurbsSurface& surface, double u, double v) {
  const auto a = homogeneous_derivatives(surface, u, v);
  const auto numerator = [&](std::size_t k, std::size_t l) { return Vector3(a[k][l].head<3>()); };
  const auto weight = [&](std::size_t k, std::size_t l) { return a[k][l].w(); };
  // The quotient rule, order by order (The NURBS Book, equation 4.20).
  const double w = weight(0, 0);
  SurfaceDerivatives d;
  d.point = numerator(0, 0) / w;
  d.du = (numerator(1, 0) - weight(1, 0) * d.point) / w;
  d.dv = (numerator(0, 1) - weight(0, 1) * d.point) / w;
  d.duu = (numerator(2, 0) - 2.0 * weight(1, 0) * d.du - weight(2, 0) * d.point) / w;
  d.dvv = (numerator(0, 2) - 2.0 * weight(0, 1) * d.dv - weight(0, 2) * d.point) / w;
  d.duv = (numerator(1, 1) - weight(1, 0) * d.dv - weight(0, 1) * d.du - weight(1, 1) * d.point) / w;
  return d;
}

NurbsCurve isoparametric_curve(const NurbsSurface& surface, double u) {
  const std::size_t span = find_span(surface.knots_u, surface.degree_u, u);
  const BasisRow basis = basis_functions(surface.knots_u, surface.degree_u, span, u);
  const std::size_t first = span - static_cast<std::size_t>(surface.degree_u);
  NurbsCurve curve{surface.degree_v, surface.knots_v, {}};
  curve.control_points.assign(surface.net.count_v, Vector4::Zero());
  for (std::size_t i = 0; i < basis.size(); ++i) {
    for (std::size_t j = 0; j < surface.net.count_v; ++j)
      curve.control_points[j] += basis[i] * surface.net.at(first + i, j);
  }
  return curve;
}

Box3 control_box(const ControlNet& net) {
  Box3 box;
  for (const Vector4& point : net.points) box.extend(cartesian(point));
  return box;
}

NurbsSurface transposed(const NurbsSurface& surface) {
  NurbsSurface result;
  result.degree_u = surface.degree_v;
  result.degree_v = surface.degree_u;
  result.knots_u = surface.knots_v;
  result.knots_v = surface.knots_u;
  result.net.count_u = surface.net.count_v;
  result.net.count_v = surface.net.count_u;
  result.net.points.reserve(surface.net.points.size());
  for (std::size_t j = 0; j < surface.net.count_v; ++j) {
    for (std::size_t i = 0; i < surface.net.count_u; ++i) result.net.points.push_back(surface.net.at(i, j));
  }
  return result;
}

}  // namespace lamina::engine
