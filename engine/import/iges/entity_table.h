#pragma once

#include <cstddef>
#include <string_view>

#include "engine/import/iges/entity_readers.h"

namespace lamina::engine {

/// Parameters, counted from 1, of an entity that point to entities which it makes its own: parameter `first`
/// alone, or as many from there on, every `stride`-th, as parameter `counted_by`, which stands before them,
/// says.
struct OwnedParameters {
  std::size_t first = 0;       ///< 0: it owns none
  std::size_t counted_by = 0;  ///< 0: just one
  std::size_t stride = 1;
  std::size_t alone = 0;  ///< one more, which stands before the counted ones; 0: none
};

/// What lamina knows of an IGES entity type.
struct EntityType {
  int number = 0;
  std::string_view name;
  NurbsCurve (*read_curve)(ParameterRecord&, EntityReader&) = nullptr;
  NurbsSurface (*read_surface)(ParameterRecord&, EntityReader&) = nullptr;
  NurbsSurface (*read_unbounded)(ParameterRecord&, EntityReader&,
                                 const std::vector<Vector3>& cover) = nullptr;
  std::vector<TrimmedPatch> (*read_faces)(ParameterRecord&, EntityReader&) = nullptr;
  /// The surfaces and faces that must not be sliced on their own, as the entity cuts, moves or repeats them.
  OwnedParameters owned{};

  /// Whether entities of the type can be part of a model by themselves.
  bool is_shape() const { return read_surface != nullptr || read_faces != nullptr; }
};

/// The row of the entity table, or nothing for a type that is not in it.
const EntityType* find_entity_type(int number);

/// Its name, "unknown entity" for types that are not in the table.
std::string_view entity_name(int number);

}  // namespace lamina::engine
