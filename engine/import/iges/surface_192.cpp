#include "engine/import/iges/analytic_axis.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"

namespace lamina::engine {

/// IGES 5.3, section 4.46: the cylinder about an axis (116, 123). u is the angle, v the height over
/// the location; the normal points outwards, as loops expect it.
NurbsSurface read_cylindrical_surface_192(ParameterRecord& record, EntityReader& reader,
                                          const std::vector<Vector3>& cover) {
  const Vector3 origin = reader.point(record, "location");
  const Vector3 axis = reader.direction(record, "axis");
  const double radius = record.real("radius");
  if (!(radius > 0.0)) record.fail("the radius must be positive");
  const AnalyticFrame frame = analytic_frame(record, reader, origin, axis);
  return turned_line(frame, range_along(frame, cover), radius, radius);
}

}  // namespace lamina::engine
