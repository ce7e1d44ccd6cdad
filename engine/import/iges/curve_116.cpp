#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"

namespace lamina::engine {

/// IGES 5.3, section 4.16: a point, given as a curve without length. As the rail of a ruled surface it makes
/// a cone.
NurbsCurve read_point_116(ParameterRecord& record, EntityReader&) {
  const Vector4 point = homogeneous(record.vector("point"));
  return {1, {0.0, 0.0, 1.0, 1.0}, {point, point}};
}

}  // namespace lamina::engine
