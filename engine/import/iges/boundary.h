#pragma once

#include "engine/import/iges/trimmed_face.h"

namespace lamina::engine {

/// The boundary to which the next parameter of `parent` points: a curve on a parametric surface (142).
Boundary read_curve_on_surface_142(ParameterRecord& parent, EntityReader& reader);

/// The same for a boundary (141).
Boundary read_boundary_141(ParameterRecord& parent, EntityReader& reader);

}  // namespace lamina::engine
