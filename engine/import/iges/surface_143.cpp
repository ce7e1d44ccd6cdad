#include "engine/import/iges/boundary.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"

namespace lamina::engine {

/// IGES 5.3, section 4.36: a surface and the boundaries (141) that cut it.
std::vector<TrimmedPatch> read_bounded_surface_143(ParameterRecord& record, EntityReader& reader) {
  record.skip(1);  // whether the boundaries have parameter curves
  const std::size_t surface = reader.child(record, "surface");
  const std::size_t count = record.count(0, "number of boundaries");
  std::vector<Boundary> boundaries;
  for (std::size_t i = 0; i < count; ++i) boundaries.push_back(read_boundary_141(record, reader));
  return trimmed_face(record, reader, read_face_surface(record, reader, surface, boundaries), boundaries,
                      false);
}

}  // namespace lamina::engine
