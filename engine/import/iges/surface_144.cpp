#include "engine/import/iges/boundary.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"

namespace lamina::engine {

/// IGES 5.3, section 4.37: a surface inside an outer curve (142) or its own border, less the insides of
/// others.
std::vector<TrimmedPatch> read_trimmed_surface_144(ParameterRecord& record, EntityReader& reader) {
  const std::size_t surface = reader.child(record, "surface");
  const bool has_outer = record.integer_or(0, "outer boundary flag") != 0;
  const std::size_t holes = record.count(0, "number of inner boundaries");
  std::vector<Boundary> boundaries;
  if (has_outer) {
    boundaries.push_back(read_curve_on_surface_142(record, reader));
  } else {
    record.skip(1);
  }
  for (std::size_t i = 0; i < holes; ++i) boundaries.push_back(read_curve_on_surface_142(record, reader));
  return trimmed_face(record, reader, read_face_surface(record, reader, surface, boundaries), boundaries,
                      !has_outer);
}

}  // namespace lamina::engine
