#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"

namespace lamina::engine {
namespace {

/// IGES 5.3, section 4.77: what belongs to a subfigure.
std::vector<TrimmedPatch> read_definition(ParameterRecord& record, EntityReader& reader) {
  record.skip(2);  // depth of nesting, name
  const std::size_t count = record.count(0, "number of entities");
  std::vector<TrimmedPatch> patches;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t member = reader.child(record, "entity");
    if (reader.entry(member).is_blanked) continue;
    for (TrimmedPatch& patch : reader.faces(member)) patches.push_back(std::move(patch));
  }
  return patches;
}

}  // namespace

/// IGES 5.3, section 4.95: a subfigure (308), scaled, then moved.
std::vector<TrimmedPatch> read_subfigure_instance_408(ParameterRecord& record, EntityReader& reader) {
  constexpr int kDefinitionType = 308;
  const std::size_t definition = reader.child(record, "subfigure");
  Vector3 by = Vector3::Zero();
  for (double& coordinate : by) coordinate = record.real_or(0.0, "translation");
  const double scale = record.real_or(1.0, "scale");
  if (!(scale > 0.0)) record.fail("the scale must be positive");
  std::vector<TrimmedPatch> patches =
      reader.part(record, definition, kDefinitionType,
                  [&](ParameterRecord& child) { return read_definition(child, reader); });
  for (TrimmedPatch& patch : patches) {
    for (Vector4& point : patch.nurbs.net.points) {
      point.head<3>() = scale * point.head<3>() + point.w() * by;
    }
  }
  return patches;
}

}  // namespace lamina::engine
