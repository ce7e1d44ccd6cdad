#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/nurbs/arc.h"

namespace lamina::engine {

/// IGES 5.3, section 4.3: the counter-clockwise arc about a center in a plane of constant z; the whole circle
/// where start and end are one point. The parameter is the angle.
NurbsCurve read_circular_arc_100(ParameterRecord& record, EntityReader& reader) {
  const double z = record.real("plane");
  const Vector2 center = record.planar_vector("center");
  const Vector2 start = record.planar_vector("start point") - center;
  const Vector2 end = record.planar_vector("end point") - center;
  const double radius = start.norm();
  if (!(radius > 0.0)) record.fail("the start point is the center: the arc has no radius");

  const double mismatch = std::abs(end.norm() - radius);
  if (mismatch > 0.01 * radius) {
    record.fail(fmt::format("the arc starts at radius {:.9g} and ends at radius {:.9g}", radius, end.norm()));
  }
  const double same_point = reader.same_point_distance(radius);
  if (mismatch > same_point)
    record.note(Tolerance::kArcRadius, fmt::format("{:.9g}, {:.9g}", end.norm(), radius));

  const double first = std::atan2(start.y(), start.x());
  double last = std::atan2(end.y(), end.x());
  if ((end - start).norm() <= same_point) last = first;
  if (last <= first) last += 2.0 * std::numbers::pi;
  return ellipse_arc({center.x(), center.y(), z}, radius * Vector3::UnitX(), radius * Vector3::UnitY(), first,
                     last);
}

}  // namespace lamina::engine
