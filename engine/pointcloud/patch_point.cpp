#include "engine/pointcloud/patch_point.h"

#include <algorithm>
#include <cmath>

namespace lamina::engine {
namespace {

constexpr int kMostNewtonSteps = 60;
constexpr double kParameterRounding = 4e-16;
/// Sine of the slope below which a surface has no section.
constexpr double kLevel = 1e-9;

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

/// A point of such a curve, with the derivatives along it and across, both times the weight.
struct BlendPoint {
  double weight;
  Vector3 position;
  Vector3 along;
  Vector3 across;

  BlendPoint(const Blend& blend, double parameter) {
    const BernsteinPair basis(blend.degree, parameter);
    Vector4 point = basis.value[0] * blend.value[0];
    Vector4 change = basis.derivative[0] * blend.value[0];
    Vector4 change_across = basis.value[0] * blend.across[0];
    for (int k = 1; k <= blend.degree; ++k) {
      point += basis.value[k] * blend.value[k];
      change += basis.derivative[k] * blend.value[k];
      change_across += basis.value[k] * blend.across[k];
    }
    weight = point.w();
    position = point.head<3>() / weight;
    // The quotient rule (The NURBS Book, equation 4.8).
    along = change.head<3>() - change.w() * position;
    across = change_across.head<3>() - change_across.w() * position;
  }
};

/// Root of a Bernstein polynomial between low and high, where it has the signs that `rising` says.
double bracketed_root(const double* coefficients, int degree, const LineCrossing& line) {
  double low = line.low;
  double high = line.high;
  double t = line.guess > low && line.guess < high ? line.guess : 0.5 * (low + high);
  double last_step = 0.0;  // of Newton's; 0: there was none
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    const BernsteinPair basis(degree, t);
    double value = 0.0;
    double slope = 0.0;
    for (int k = 0; k <= degree; ++k) {
      value += basis.value[k] * coefficients[k];
      slope += basis.derivative[k] * coefficients[k];
    }
    if (value == 0.0) return t;
    ((value > 0.0) == line.rising ? high : low) = t;
    double next = t - value / slope;
    const bool is_newton = next >= low && next <= high;
    if (!is_newton) next = 0.5 * (low + high);
    const double size = std::abs(next - t);
    // Newton steps that shrink from `last_step` to `size` by squaring have size^3 / last_step^2 to come.
    if (size <= kParameterRounding ||
        (is_newton && size < last_step && size * size * size <= kParameterRounding * last_step * last_step))
      return next;
    last_step = is_newton ? size : 0.0;
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
  result.parameter = bracketed_root(heights, blend.degree, line);

  const BlendPoint at(blend, result.parameter);
  result.node.parameters = parameters_on(line.held, line.at, result.parameter);
  result.node.position = at.position.head<2>();
  result.slope = -at.across.z() / at.along.z();
  result.node.tangent = line.held == Direction::kU ? section_tangent(at.across, at.along)
                                                   : section_tangent(at.along, at.across);
  return result;
}

PatchPoint point_at(const FrontPatch& patch, const Vector2& parameters) {
  const Blend blend(patch, Direction::kU, parameters.x());
  const BlendPoint at(blend, parameters.y());
  return {at.position, at.across / at.weight, at.along / at.weight};
}

Vector2 section_tangent(const Vector3& du, const Vector3& dv) {
  // e_z x (du x dv)
  const Vector2 tangent = du.head<2>() * dv.z() - dv.head<2>() * du.z();
  const double squared = tangent.squaredNorm();
  const double scale = du.squaredNorm() * dv.squaredNorm();
  return squared > kLevel * kLevel * scale ? Vector2(tangent / std::sqrt(squared)) : Vector2(Vector2::Zero());
}

EdgePoint point_on_line(const FrontPatch& patch, Direction held, double at, double parameter) {
  const PatchPoint point = point_at(patch, parameters_on(held, at, parameter));
  const Vector3 normal = point.du.cross(point.dv);
  const double length = normal.norm();
  return {point.position.head<2>(), (held == Direction::kU ? point.dv : point.du).head<2>(),
          length > 0.0 ? std::abs(normal.z()) / length : 0.0};
}

}  // namespace lamina::engine
