#include "engine/nurbs/reverse.h"

#include <algorithm>

namespace lamina::engine {

NurbsCurve reversed(const NurbsCurve& curve) {
  NurbsCurve result = curve;
  std::reverse(result.control_points.begin(), result.control_points.end());
  std::reverse(result.knots.begin(), result.knots.end());
  // Ends map to each other exactly, so that repeated end knots stay repeated.
  const double first = curve.first_parameter();
  const double last = curve.last_parameter();
  for (double& knot : result.knots)
    knot = knot == first ? last : (knot == last ? first : first + (last - knot));
  return result;
}

}  // namespace lamina::engine
