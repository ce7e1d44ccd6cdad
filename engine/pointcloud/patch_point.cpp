#include "engine/pointcloud/patch_point.h"

#include <algorithm>
#include <cmath>

namespace lamina::engine {
namespace {

constexpr int kMostNewtonSteps = 60;
constexpr double kParameterRounding = 4e-16;

/// A patch blended along the direction held: a curve along the other one, and its derivative across.
struct Blend {
  int degree = 0;
  Vector4 value[kHighestPatchDegree + 1];
  Vector4 across[kHighestPatchDegree + 1];

  Blend(const FrontPatch& patch, Direction held, double at) {
    const bool held_u = held == Direction::kU;
    degree = held_u ? patch.degree_v : patch.degree_u;
    const int held_degree = held_u ? patch.degree_u : patch.degree_v;
    const std::ptrdiff_t step = held_u ? patch.degree_v + 1 : 1;
    const std::ptrdiff_t stride = held_u ? 1 : patch.degree_v + 1;
    const BernsteinPair basis(held_degree, at);
    const Vector4* const points = patch.points().data();
    for (int k = 0; k <= degree; ++k) {
      const Vector4* point = points + k * stride;
      Vector4 sum = basis.value[0] * *point;
      Vector4 slope = basis.derivative[0] * *point;
      for (int l = 1; l <= held_degree; ++l) {
        point += step;
        sum += basis.value[l] * *point;
        slope += basis.derivative[l] * *point;
      }
      value[k] = sum;
      across[k] = slope;
    }
  }
};

/// Root of a Bernstein polynomial between low and high, where it has the signs that `rising` says.
double bracketed_root(const double* coefficients, int degree, double low, double high, bool rising) {
  double t = 0.5 * (low + high);
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    const BernsteinPair basis(degree, t);
    double value = 0.0;
    double slope = 0.0;
    for (int k = 0; k <= degree; ++k) {
      value += basis.value[k] * coefficients[k];
      slope += basis.derivative[k] * coefficients[k];
    }
    if (value == 0.0) return t;
    ((value > 0.0) == rising ? high : low) = t;
    double next = t - value / slope;
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (std::abs(next - t) <= kParameterRounding) return next;
    t = next;
  }
  return t;
}

}  // namespace

BernsteinPair::BernsteinPair(int degree, double t) {
  // The basis of one degree less carries both the values and the derivatives.
  const double s = 1.0 - t;
  value[0] = 1.0;
  for (int n = 1; n < degree; ++n) {
    double saved = 0.0;
    for (int k = 0; k < n; ++k) {
      const double held = value[k];
      value[k] = saved + s * held;
      saved = t * held;
    }
    value[n] = saved;
  }
  double previous = 0.0;
  for (int k = 0; k < degree; ++k) {
    const double held = value[k];
    derivative[k] = degree * (previous - held);
    value[k] = t * previous + s * held;
    previous = held;
  }
  derivative[degree] = degree * previous;
  value[degree] = t * previous;
}

CrossingPoint crossing_on_line(const FrontPatch& patch, double z, const LineCrossing& line) {
  const Blend blend(patch, line.held, line.at);
  double heights[kHighestPatchDegree + 1];
  for (int k = 0; k <= blend.degree; ++k) heights[k] = blend.value[k].z() - z * blend.value[k].w();
  CrossingPoint result;
  result.parameter = bracketed_root(heights, blend.degree, line.low, line.high, line.rising);

  const BernsteinPair basis(blend.degree, result.parameter);
  Vector4 point = basis.value[0] * blend.value[0];
  Vector4 along = basis.derivative[0] * blend.value[0];
  Vector4 across = basis.value[0] * blend.across[0];
  for (int k = 1; k <= blend.degree; ++k) {
    point += basis.value[k] * blend.value[k];
    along += basis.derivative[k] * blend.value[k];
    across += basis.value[k] * blend.across[k];
  }
  result.node.parameters = parameters_on(line.held, line.at, result.parameter);
  const double w = point.w();
  result.node.position = point.head<2>() / w;
  // Quotient rule; the common factor 1 / w does not turn the tangent.
  const Vector3 cartesian = point.head<3>() / w;
  const Vector3 d_along = along.head<3>() - along.w() * cartesian;
  const Vector3 d_across = across.head<3>() - across.w() * cartesian;
  const Vector3& du = line.held == Direction::kU ? d_across : d_along;
  const Vector3& dv = line.held == Direction::kU ? d_along : d_across;
  // e_z x (du x dv): the section's direction, the outward normal on its right.
  const Vector2 tangent = du.head<2>() * dv.z() - dv.head<2>() * du.z();
  const double length = tangent.norm();
  const double scale = du.norm() * dv.norm();
  result.node.tangent = length > 1e-9 * scale ? Vector2(tangent / length) : Vector2(Vector2::Zero());
  return result;
}

EdgePoint point_on_line(const FrontPatch& patch, Direction held, double at, double parameter) {
  const Blend blend(patch, held, at);
  const BernsteinPair basis(blend.degree, parameter);
  Vector4 point = Vector4::Zero();
  Vector4 along = Vector4::Zero();
  Vector4 across = Vector4::Zero();
  for (int k = 0; k <= blend.degree; ++k) {
    point += basis.value[k] * blend.value[k];
    along += basis.derivative[k] * blend.value[k];
    across += basis.value[k] * blend.across[k];
  }
  const Vector3 cartesian = point.head<3>() / point.w();
  const Vector3 d_along = (along.head<3>() - along.w() * cartesian) / point.w();
  const Vector3 d_across = (across.head<3>() - across.w() * cartesian) / point.w();
  const Vector3 normal = d_along.cross(d_across);
  const double length = normal.norm();
  return {cartesian.head<2>(), d_along.head<2>(), length > 0.0 ? std::abs(normal.z()) / length : 0.0};
}

}  // namespace lamina::engine
