#include <algorithm>
#include <vector>

#include "engine/import/iges/boundary.h"
#include "engine/import/iges/parameter_record.h"
#include "engine/nurbs/reverse.h"

namespace lamina::engine {

/// IGES 5.3, section 4.34: curves in space one after the other, each with its sense and with curves in the
/// parameter plane where the type says so.
Boundary read_boundary_141(ParameterRecord& parent, EntityReader& reader) {
  constexpr int kType = 141;
  constexpr int kReversed = 2;
  constexpr int kPreferSpace = 1;
  const std::size_t index = reader.child(parent, "boundary");
  return reader.part(parent, index, kType, [&](ParameterRecord& record) {
    record.skip(1);  // whether there are parameter curves: their counts say so, too
    Boundary boundary;
    boundary.prefers_space = record.integer_or(0, "preference") == kPreferSpace;
    record.skip(1);  // the surface
    const std::size_t count = record.count(1, "number of curves");
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<NurbsCurve> pieces = reader.pieces(record, reader.child(record, "model curve"));
      const bool is_reversed = record.integer_or(1, "sense") == kReversed;
      if (is_reversed) {
        std::reverse(pieces.begin(), pieces.end());
        for (NurbsCurve& piece : pieces) piece = reversed(piece);
      }
      boundary.in_space.insert(boundary.in_space.end(), pieces.begin(), pieces.end());
      const std::size_t parameter_curves = record.count(0, "number of parameter curves");
      for (std::size_t k = 0; k < parameter_curves; ++k) {
        const std::vector<NurbsCurve> in_parameters =
            reader.pieces(record, reader.child(record, "parameter curve"));
        boundary.in_parameters.insert(boundary.in_parameters.end(), in_parameters.begin(),
                                      in_parameters.end());
      }
    }
    return boundary;
  });
}

}  // namespace lamina::engine
