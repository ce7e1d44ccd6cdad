#pragma once

#include <string>
#include <string_view>

#include "engine/import/import_result.h"

namespace lamina::engine {

/// Whether the bytes are text that begins with statements of an OBJ file.
bool looks_like_obj(std::string_view bytes);

/// Reads the polygons of a Wavefront OBJ file, taken as mm: vertices (v) and faces (f), with indices from 1
/// or backwards from -1. Faces of more than three corners are fanned from their first. Texture coordinates,
/// normals, groups, materials, lines and points are passed over; free-form curves and surfaces are listed as
/// skipped. Vertices are one where they are equal bit by bit. Tolerated and reported: faces with a corner
/// that is not finite or beyond 1e9, or of fewer than three corners (left out). Throws ImportError, naming
/// `file` and line, for anything else that is wrong. Besides the bytes, memory stays below
/// four times their number.
ImportResult read_obj(std::string_view bytes, const std::string& file);

}  // namespace lamina::engine
