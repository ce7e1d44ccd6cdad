#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/geometry/vector.h"
#include "engine/nurbs/surface.h"

namespace lamina::engine {

/// The Bezier segments of a knot vector as matrices: segment s has the control points
/// b_k = sum_j weight(s, k, j) * p_(first(s) + j) of the spline's p (Bezier extraction; Borden, Scott, Evans
/// and Hughes, Isogeometric finite element data structures based on Bezier extraction of NURBS, 2011). Found
/// by blossoms, clamped or not.
class BezierSpans {
 public:
  BezierSpans(const Knots& knots, int degree);

  std::size_t count() const { return firsts_.size(); }
  int degree() const { return degree_; }
  /// First control point of the spline that segment s depends on.
  std::size_t first(std::size_t s) const { return firsts_[s]; }
  /// (degree + 1)^2 weights, k slow, j fast.
  const double* weights(std::size_t s) const { return weights_.data() + s * order() * order(); }

 private:
  std::size_t order() const { return static_cast<std::size_t>(degree_) + 1; }

  int degree_;
  std::vector<std::size_t> firsts_;
  std::vector<double> weights_;
};

}  // namespace lamina::engine
