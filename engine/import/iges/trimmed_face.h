#pragma once

#include <vector>

#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/parameter_map.h"
#include "engine/import/trim/trimmed_patch.h"

namespace lamina::engine {

/// A loop around a face as a file gives it.
struct Boundary {
  std::vector<NurbsCurve> in_parameters;  ///< pieces in the parameter plane of IGES; empty where not given
  std::vector<NurbsCurve> in_space;       ///< pieces in model space; empty where not given
  bool prefers_space = false;
};

/// Points that the surface of these boundaries must reach around: control points of the pieces in space.
std::vector<Vector3> cover_of(const std::vector<Boundary>& boundaries);

/// The surface of a face before it is cut.
struct FaceSurface {
  NurbsSurface nurbs;
  ParameterMap map{};
  bool has_parameters = true;  ///< whether parameter curves of the file can mean it
};

/// Reads the surface of a face that a parameter of `record` gave.
FaceSurface read_face_surface(ParameterRecord& record, EntityReader& reader, std::size_t index,
                              const std::vector<Boundary>& boundaries);

/// The face inside its boundaries: parameter curves where there are any and they agree with the curves in
/// space, else these, projected. No patch, and a note, where the boundaries cannot be laid out.
std::vector<TrimmedPatch> trimmed_face(ParameterRecord& record, EntityReader& reader,
                                       const FaceSurface& surface, const std::vector<Boundary>& boundaries,
                                       bool whole_outside);

}  // namespace lamina::engine
