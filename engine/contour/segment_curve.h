#pragma once

#include <cstddef>

#include "engine/contour/contour_node.h"

namespace lamina::engine {

/// The contour between two nodes as the cubic through both with their tangents (Hermite); a straight line
/// where a tangent is not known. Between nodes a small turn apart it is nearer to the true section than the
/// chord is by the square of that turn.
class SegmentCurve {
 public:
  SegmentCurve(const NodeChain& chain, std::size_t segment);

  Vector2 point(double t) const;  ///< t in [0, 1]
  Vector2 derivative(double t) const;
  Vector2 tangent(double t) const;  ///< unit

  /// Parameter of the chord's point nearest to a place.
  double parameter_near(const Vector2& place) const;

 private:
  Vector2 start_;
  Vector2 end_;
  Vector2 start_slope_;
  Vector2 end_slope_;
};

struct CurveMeeting {
  Vector2 position;
  double first = 0.0;  ///< parameter on the first curve
  double second = 0.0;
};

/// Where two curves cross near a place, by Newton steps. Where they run alongside each other, or the steps
/// lead away, the place itself.
CurveMeeting meet(const SegmentCurve& first, const SegmentCurve& second, const Vector2& place);

}  // namespace lamina::engine
