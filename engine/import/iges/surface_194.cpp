#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/import/iges/analytic_axis.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"

namespace lamina::engine {

/// IGES 5.3, section 4.47: the cone about an axis (116, 123), of a radius at the location and a half angle in
/// degrees by which it widens along the axis. u is the angle, v the height over the location; the normal
/// points outwards.
NurbsSurface read_conical_surface_194(ParameterRecord& record, EntityReader& reader,
                                      const std::vector<Vector3>& cover) {
  const Vector3 origin = reader.point(record, "location");
  const Vector3 axis = reader.direction(record, "axis");
  const double radius = record.real("radius");
  const double half_angle = record.real("half angle");
  if (!(radius >= 0.0 && half_angle > 0.0 && half_angle < 90.0))
    record.fail("the radius must not be negative, and the half angle between 0 and 90 degrees");
  const AnalyticFrame frame = analytic_frame(record, reader, origin, axis);
  const double slope = std::tan(half_angle * std::numbers::pi / 180.0);
  AxisRange range = range_along(frame, cover);
  // The apex is the end of the cone, whatever room there is behind it; points of a face are on one side.
  const double apex = -radius / slope;
  if (range.first < apex) {
    const double middle = 0.5 * (range.first + range.last);
    (middle > apex ? range.first : range.last) = apex;
  }
  return turned_line(frame, range, std::abs(radius + slope * range.first),
                     std::abs(radius + slope * range.last));
}

}  // namespace lamina::engine
