#include <utility>

#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"

namespace lamina::engine {
namespace {

void append(std::vector<TrimmedPatch>& patches, std::vector<TrimmedPatch> more) {
  for (TrimmedPatch& patch : more) patches.push_back(std::move(patch));
}

}  // namespace

/// IGES 5.3, section 4.152: faces (510), each with its sense, which slicing does not need.
std::vector<TrimmedPatch> read_shell_514(ParameterRecord& record, EntityReader& reader) {
  const std::size_t count = record.count(1, "number of faces");
  std::vector<TrimmedPatch> patches;
  for (std::size_t i = 0; i < count; ++i) {
    append(patches, reader.faces(reader.child(record, "face")));
    record.skip(1);
  }
  return patches;
}

/// IGES 5.3, section 4.43: an outer shell (514) and those of voids.
std::vector<TrimmedPatch> read_solid_186(ParameterRecord& record, EntityReader& reader) {
  std::vector<TrimmedPatch> patches = reader.faces(reader.child(record, "shell"));
  record.skip(1);
  const std::size_t voids = record.count(0, "number of voids");
  for (std::size_t i = 0; i < voids; ++i) {
    append(patches, reader.faces(reader.child(record, "shell of a void")));
    record.skip(1);
  }
  return patches;
}

}  // namespace lamina::engine
