#pragma once

#include <cstddef>
#include <string_view>

#include "engine/import/iges/entity_readers.h"

namespace lamina::engine {

/// Parameters, counted from 1, of an entity that point to entities which it makes its own: parameter `first`
/// alone, or as many from there on as parameter `counted_by`, which stands before them, says.
struct OwnedParameters {
  std::size_t first = 0;       ///< 0: it owns none
  std::size_t counted_by = 0;  ///< 0: just one
};

/// What lamina knows of an IGES entity type.
struct EntityType {
  int number = 0;
  std::string_view name;
  NurbsCurve (*read_curve)(ParameterRecord&, EntityReader&) = nullptr;
  NurbsSurface (*read_surface)(ParameterRecord&, EntityReader&) = nullptr;
  /// For types that cannot be read yet: the surfaces that must not be sliced on their own, as the entity
  /// cuts, moves or repeats them.
  OwnedParameters owned;
};

/// The row of the entity table, or nothing for a type that is not in it.
const EntityType* find_entity_type(int number);

/// Its name, "unknown entity" for types that are not in the table.
std::string_view entity_name(int number);

}  // namespace lamina::engine
