#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"
#include "engine/import/iges/plane_patch.h"
#include "engine/import/iges/trimmed_face.h"

namespace lamina::engine {
namespace {

constexpr int kUnbounded = 0;

/// a x + b y + c z = d.
struct Plane {
  Vector3 normal;
  double offset = 0.0;

  Vector3 point() const { return offset / normal.squaredNorm() * normal; }
};

Plane read_coefficients(ParameterRecord& record) {
  Plane plane{record.vector("normal"), record.real("offset")};
  if (!(plane.normal.norm() > 0.0)) record.fail("the plane has no normal: A, B and C are 0");
  return plane;
}

}  // namespace

/// IGES 5.3, section 4.8, without its boundary.
NurbsSurface read_plane_108(ParameterRecord& record, EntityReader&, const std::vector<Vector3>& cover) {
  const Plane plane = read_coefficients(record);
  return plane_patch(plane.point(), plane.normal, cover);
}

/// IGES 5.3, section 4.8: what a closed curve bounds (form 1). Form 0 has no end, form -1 is a hole in
/// another plane: neither is a face.
std::vector<TrimmedPatch> read_bounded_plane_108(ParameterRecord& record, EntityReader& reader) {
  const Plane plane = read_coefficients(record);
  const auto index = reader.child_or_none(record, "boundary");
  if (record.entry().form <= kUnbounded || !index) return {};
  const std::vector<Boundary> boundaries{{{}, reader.pieces(record, *index), false}};
  const NurbsSurface surface = plane_patch(plane.point(), plane.normal, cover_of(boundaries));
  return trimmed_face(record, reader, {surface, {}, false}, boundaries, false);
}

}  // namespace lamina::engine
