#include <numbers>

#include <fmt/format.h>

#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"
#include "engine/nurbs/revolution.h"

namespace lamina::engine {

/// IGES 5.3, section 4.19: a curve turned about a line, counter-clockwise about its direction, between two
/// angles.
NurbsSurface read_surface_of_revolution_120(ParameterRecord& record, EntityReader& reader) {
  constexpr double kFullTurn = 2.0 * std::numbers::pi;
  constexpr double kRounding = 1e-6;
  const EntityReader::Axis axis = reader.axis(record, "axis of revolution");
  const Vector3 direction = axis.end - axis.start;
  if (!(direction.norm() > 0.0))
    record.fail("the axis of revolution has no direction: its line has no length");
  const NurbsCurve generatrix = reader.curve(record, "generatrix");
  const double first = record.real("start angle");
  double last = record.real("end angle");
  if (!(last > first)) {
    record.fail(fmt::format("the end angle is {}, and must be above the start angle, {}", last, first));
  }
  if (last - first > kFullTurn + kRounding) {
    record.fail(fmt::format("the angles are from {} to {}, more than a full turn apart", first, last));
  }
  // A full turn written with few digits is meant to close.
  if (last - first > kFullTurn - kRounding) last = first + kFullTurn;
  reader.spend(record, 9 * generatrix.control_points.size());
  return surface_of_revolution(generatrix, axis.start, direction, first, last);
}

}  // namespace lamina::engine
