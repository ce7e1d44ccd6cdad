#pragma once

#include <vector>

#include "engine/contour/fit/banded_cholesky.h"
#include "engine/geometry/basis_window.h"
#include "engine/geometry/planar_curve.h"

namespace lamina::engine {

/// A point that a spline has to meet.
struct FitSample {
  Vector2 position = Vector2::Zero();
  Vector2 tangent = Vector2::Zero();  ///< unit
  double walked = 0.0;                ///< arc length from the first sample, mm
  double parameter = 0.0;             ///< where on the spline; ascending over the samples
};

/// Least-squares splines of degree 2 to 5 through the first and the last sample, along the tangents there.
///
/// Minimised is the sum of squared distances across the samples' tangents, with those along them at a small
/// weight: tangent distance minimisation (Wang, Pottmann, Liu, Fitting B-spline curves to point clouds by
/// curvature-based squared distance minimization, ACM TOG 25, 2006). Alternated with `correct_parameters` it
/// converges fast to the best curve under any parametrisation. Linear in samples and control points. Keeps
/// its storage from call to call.
class SplineSystem {
 public:
  /// Sets the control points of `curve`, whose degree and clamped knots are given; at least three control
  /// points. False, and the curve is unusable, if the samples do not determine it. The second and the last
  /// but one control point lie on the end tangents, possibly on the wrong side of the ends.
  bool solve(PlanarCurve& curve, const std::vector<FitSample>& samples);

  /// After `solve` with the same arguments: moves each parameter to the foot point of its sample, to first
  /// order. Returns the greatest distance of a sample from the curve for each knot span, mm, to second order.
  std::vector<double> correct_parameters(const PlanarCurve& curve, std::vector<FitSample>& samples);

 private:
  template <int kDegree>
  void assemble(const PlanarCurve& curve, const std::vector<FitSample>& samples);
  void turn_unknowns(std::size_t control, const Vector2& direction);
  void fix(std::size_t unknown, double value);

  BandedMatrix matrix_;
  std::vector<double> right_;
  std::vector<BasisWindow> windows_;  // one for each sample
};

}  // namespace lamina::engine
