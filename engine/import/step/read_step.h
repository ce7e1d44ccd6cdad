#pragma once

#include <string>
#include <string_view>

#include "engine/import/import_result.h"

namespace lamina::engine {

/// Whether the bytes start like a STEP file (ISO 10303-21).
bool looks_like_step(std::string_view bytes);

/// Whether the bytes start like OpenCASCADE's own format, .brep, in its text form.
bool looks_like_brep(std::string_view bytes);

/// Reads a STEP file (AP203, AP214, AP242) through OpenCASCADE: solids, shells and loose faces of all its
/// products, placed as its assemblies say, as NURBS surfaces in mm with their trim loops. Throws ImportError,
/// naming `file`, where the file cannot be read, holds no faces, or lamina was built without OpenCASCADE.
ImportResult read_step(std::string_view bytes, const std::string& file);

/// The same for .brep, whose unit is the mm.
ImportResult read_brep(std::string_view bytes, const std::string& file);

}  // namespace lamina::engine
