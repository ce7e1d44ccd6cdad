#include <fmt/format.h>

#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"

namespace lamina::engine {

/// IGES 5.3, section 4.13: the segment between two points, on [0, 1]. Forms 1 and 2 go on beyond one or both.
NurbsCurve read_line_110(ParameterRecord& record, EntityReader&) {
  const Vector3 start = record.vector("start point");
  const Vector3 end = record.vector("end point");
  if (record.entry().form != 0)
    record.note(Tolerance::kUnboundedLine, fmt::format("form {}", record.entry().form));
  return {1, {0.0, 0.0, 1.0, 1.0}, {homogeneous(start), homogeneous(end)}};
}

}  // namespace lamina::engine
