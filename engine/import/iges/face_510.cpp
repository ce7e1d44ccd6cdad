#include <algorithm>

#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"
#include "engine/import/iges/trimmed_face.h"
#include "engine/nurbs/reverse.h"

namespace lamina::engine {
namespace {

constexpr int kLoop = 508;

/// IGES 5.3, section 4.150: edges one after the other, each with its sense. Vertices stand where an edge has
/// no length; curves in the parameter plane are passed over.
Boundary read_loop(ParameterRecord& parent, EntityReader& reader) {
  constexpr int kEdge = 0;
  return reader.part(parent, reader.child(parent, "loop"), kLoop, [&](ParameterRecord& record) {
    Boundary boundary;
    const std::size_t count = record.count(1, "number of edges");
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_edge = record.integer_or(kEdge, "kind of edge") == kEdge;
      const std::size_t list = reader.child(record, "edge list");
      const int number = record.integer("number of the edge in its list");
      const bool is_reversed = record.integer_or(1, "sense") == 0;
      const std::size_t parameter_curves = record.count(0, "number of parameter curves");
      record.skip(2 * parameter_curves);
      if (!is_edge) continue;
      std::vector<NurbsCurve> pieces = reader.edge(record, list, number);
      if (is_reversed) {
        std::reverse(pieces.begin(), pieces.end());
        for (NurbsCurve& piece : pieces) piece = reversed(piece);
      }
      boundary.in_space.insert(boundary.in_space.end(), pieces.begin(), pieces.end());
    }
    return boundary;
  });
}

}  // namespace

/// IGES 5.3, section 4.151: a surface inside loops (508).
std::vector<TrimmedPatch> read_face_510(ParameterRecord& record, EntityReader& reader) {
  const std::size_t surface = reader.child(record, "surface");
  const std::size_t count = record.count(1, "number of loops");
  record.skip(1);  // whether the first loop is the outer one
  std::vector<Boundary> boundaries;
  for (std::size_t i = 0; i < count; ++i) boundaries.push_back(read_loop(record, reader));
  return trimmed_face(record, reader, read_face_surface(record, reader, surface, boundaries), boundaries,
                      false);
}

}  // namespace lamina::engine
