#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/plane_patch.h"

namespace lamina::engine {

/// IGES 5.3, section 4.45: the plane through a point (116) with a normal (123).
NurbsSurface read_plane_surface_190(ParameterRecord& record, EntityReader& reader,
                                    const std::vector<Vector3>& cover) {
  const Vector3 origin = reader.point(record, "location");
  const Vector3 normal = reader.direction(record, "normal");
  return plane_patch(origin, normal, cover);
}

}  // namespace lamina::engine
