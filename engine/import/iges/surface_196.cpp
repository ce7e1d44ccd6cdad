#include <numbers>

#include "engine/import/iges/analytic_axis.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"
#include "engine/nurbs/arc.h"
#include "engine/nurbs/revolution.h"

namespace lamina::engine {

/// IGES 5.3, section 4.48: the sphere about a point (116). u is the longitude, v the latitude, rad; the
/// normal points outwards.
NurbsSurface read_spherical_surface_196(ParameterRecord& record, EntityReader& reader) {
  constexpr int kParametrised = 1;
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  const Vector3 center = reader.point(record, "center");
  const double radius = record.real("radius");
  if (!(radius > 0.0)) record.fail("the radius must be positive");
  Vector3 axis = Vector3::UnitZ();
  if (record.entry().form == kParametrised && !record.at_end()) axis = reader.direction(record, "axis");
  const AnalyticFrame frame = analytic_frame(record, reader, center, axis);
  const NurbsCurve meridian =
      ellipse_arc(center, radius * frame.reference, radius * frame.axis, -kQuarter, kQuarter);
  return transposed(surface_of_revolution(meridian, center, frame.axis, 0.0, 4.0 * kQuarter));
}

}  // namespace lamina::engine
