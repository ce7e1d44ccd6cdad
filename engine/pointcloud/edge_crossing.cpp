#include "engine/pointcloud/edge_crossing.h"

#include <algorithm>
#include <cmath>

namespace lamina::engine {
namespace {

constexpr int kMostSteps = 80;
/// Height over the plane that counts as in it, mm.
constexpr double kInPlane = 1e-12;
/// A Newton step below this part of the bracket squares to less than rounding.
constexpr double kLastStep = 1e-8;

}  // namespace

PatchPoint surface_point(const FrontPatch& patch, const Vector2& parameters) {
  const Vector2 size = patch.high() - patch.low();
  const Vector2 local = (parameters - patch.low()).cwiseQuotient(size);
  if (local.minCoeff() >= 0.0 && local.maxCoeff() <= 1.0) {
    const PatchPoint point = point_at(patch, local);
    return {point.position, point.du / size.x(), point.dv / size.y()};
  }
  const SurfaceDerivatives d = evaluate_derivatives(patch.trim()->surface(), parameters.x(), parameters.y());
  return {d.point, d.du, d.dv};
}

std::optional<PatchPoint> edge_crossing(const FrontPatch& patch, const BezierChain& curve, double guess,
                                        const EdgeSample& first, const EdgeSample& last, double z) {
  const double width = last.t - first.t;
  double low = first.t;
  double high = last.t;
  const bool rising = first.position.z() < last.position.z();
  const bool bracketed = (first.position.z() > z) != (last.position.z() > z);
  if (!bracketed) {
    // A curve that bends between its samples may pass twice, or just beyond one of them.
    low = std::max(low - width, curve.breaks.front());
    high = std::min(high + width, curve.breaks.back());
  }
  double t = guess;
  for (int step = 0; step < kMostSteps; ++step) {
    const CurveDerivative on_curve = evaluate_derivative(curve, t);
    PatchPoint point = surface_point(patch, on_curve.point.head<2>());
    const double f = point.position.z() - z;
    if (std::abs(f) < kInPlane) return point;
    const Vector3 slope = point.du * on_curve.tangent.x() + point.dv * on_curve.tangent.y();
    const double by = -f / slope.z();
    if (std::abs(by) <= kLastStep * width) {
      point.position += by * slope;
      return point;
    }
    if (bracketed) {
      // Newton steps kept inside the bracket.
      ((f > 0.0) == rising ? high : low) = t;
      t = t + by > low && t + by < high ? t + by : 0.5 * (low + high);
    } else {
      t += by;
      if (!(t >= low && t <= high)) return std::nullopt;
    }
  }
  return std::nullopt;
}

}  // namespace lamina::engine
