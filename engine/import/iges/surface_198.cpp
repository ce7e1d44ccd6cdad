#include <numbers>

#include "engine/import/iges/analytic_axis.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"
#include "engine/nurbs/arc.h"
#include "engine/nurbs/revolution.h"

namespace lamina::engine {

/// IGES 5.3, section 4.49: the torus about an axis (116, 123). u goes round the axis, v round the
/// tube, rad; the normal points outwards.
NurbsSurface read_toroidal_surface_198(ParameterRecord& record, EntityReader& reader) {
  constexpr double kFullTurn = 2.0 * std::numbers::pi;
  const Vector3 center = reader.point(record, "center");
  const Vector3 axis = reader.direction(record, "axis");
  const double major = record.real("major radius");
  const double minor = record.real("minor radius");
  if (!(major > 0.0 && minor > 0.0)) record.fail("both radii must be positive");
  const AnalyticFrame frame = analytic_frame(record, reader, center, axis);
  const NurbsCurve tube = ellipse_arc(center + major * frame.reference, minor * frame.reference,
                                      minor * frame.axis, 0.0, kFullTurn);
  return transposed(surface_of_revolution(tube, center, frame.axis, 0.0, kFullTurn));
}

}  // namespace lamina::engine
