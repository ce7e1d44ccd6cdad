#pragma once

#include <vector>

#include "engine/import/iges/entity_reader.h"

namespace lamina::engine {

/// Where an analytic surface of revolution stands: its own axes, all of length 1.
struct AnalyticFrame {
  Vector3 origin;
  Vector3 axis;
  Vector3 reference;  ///< where the angle is 0
};

/// A frame at right angles from an axis and, in forms that give one, a reference direction (123) near to one.
AnalyticFrame analytic_frame(ParameterRecord& record, EntityReader& reader, const Vector3& origin,
                             const Vector3& axis);

/// Part of the axis, from its origin, that points lie beside, with some room around.
struct AxisRange {
  double first = -1.0;
  double last = 1.0;
};
AxisRange range_along(const AnalyticFrame& frame, const std::vector<Vector3>& cover);

/// The full turn of a straight line about the axis: at the ends of `range` at these distances from it. u is
/// the angle, v the height; the normal points away from the axis.
NurbsSurface turned_line(const AnalyticFrame& frame, const AxisRange& range, double first_radius,
                         double last_radius);

}  // namespace lamina::engine
