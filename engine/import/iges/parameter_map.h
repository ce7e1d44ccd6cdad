#pragma once

#include <cstddef>

#include "engine/import/iges/entity_reader.h"
#include "engine/import/trim/axis_map.h"

namespace lamina::engine {

/// How the parameters of IGES map to those of the surface that entity `index` was read as.
ParameterMap parameter_map(EntityReader& reader, ParameterRecord& parent, std::size_t index,
                           const NurbsSurface& surface);

}  // namespace lamina::engine
