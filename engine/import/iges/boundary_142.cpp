#include "engine/import/iges/boundary.h"
#include "engine/import/iges/parameter_record.h"

namespace lamina::engine {

/// IGES 5.3, section 4.35: one curve, in the parameter plane, in space or both, and which of them is meant.
Boundary read_curve_on_surface_142(ParameterRecord& parent, EntityReader& reader) {
  constexpr int kType = 142;
  constexpr int kPreferSpace = 2;
  const std::size_t index = reader.child(parent, "boundary");
  return reader.part(parent, index, kType, [&](ParameterRecord& record) {
    record.skip(2);  // how it was made, the surface
    Boundary boundary;
    if (const auto curve = reader.child_or_none(record, "parameter curve"))
      boundary.in_parameters = reader.pieces(record, *curve);
    if (const auto curve = reader.child_or_none(record, "model curve"))
      boundary.in_space = reader.pieces(record, *curve);
    boundary.prefers_space = record.integer_or(0, "preference") == kPreferSpace;
    if (boundary.in_parameters.empty() && boundary.in_space.empty())
      record.fail("the boundary has neither a parameter curve nor a model curve");
    return boundary;
  });
}

}  // namespace lamina::engine
