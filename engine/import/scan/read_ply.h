#pragma once

#include <string>
#include <string_view>

#include "engine/import/import_result.h"

namespace lamina::engine {

/// Whether bytes are the beginning of a PLY file.
bool looks_like_ply(std::string_view bytes);

/// Reads a PLY file (Turk, 1994): ascii, or binary in either byte order. With faces it is a mesh of
/// triangles, polygons cut into fans; without, a scan. Lengths count as mm. Throws ImportError.
ImportResult read_ply(std::string_view bytes, const std::string& file);

}  // namespace lamina::engine
