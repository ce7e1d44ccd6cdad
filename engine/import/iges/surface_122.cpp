#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"
#include "engine/nurbs/ruled.h"

namespace lamina::engine {

/// IGES 5.3, section 4.20: a curve moved along a line whose start is the curve's start and whose end is
/// given. u in [0, 1] runs along the curve, v in [0, 1] along the line.
NurbsSurface read_tabulated_cylinder_122(ParameterRecord& record, EntityReader& reader) {
  const NurbsCurve directrix = reader.curve(record, "directrix");
  const Vector3 by = record.vector("end of the generatrix") - cartesian(directrix.control_points.front());
  if (!(by.norm() > 0.0)) record.fail("the generatrix has no length");
  NurbsCurve opposite = directrix;
  for (Vector4& point : opposite.control_points) point.head<3>() += point.w() * by;
  return ruled_surface(directrix, opposite);
}

}  // namespace lamina::engine
