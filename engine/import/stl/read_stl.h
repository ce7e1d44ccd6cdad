#pragma once

#include <string>
#include <string_view>

#include "engine/import/import_result.h"

namespace lamina::engine {

/// Whether the bytes are an STL file, binary or text: by their structure, whatever their first word. A binary
/// file whose size does not fit its count is not recognised.
bool looks_like_stl(std::string_view bytes);

/// Reads an STL file, mm. Which of the two kinds it is, its structure says: a binary file may begin with
/// "solid". Facets become triangles as they are, in the order of the file; corners are one vertex where they
/// are equal bit by bit. Normals are left out, they say nothing that the corners do not.
///
/// Tolerated and reported: bytes behind the last facet, a binary count that was never filled in (0 or all
/// bits set), facets with coordinates that are not finite or beyond 1e9 (left out), polygons in the text form
/// (fanned), a missing endsolid. Throws ImportError, naming `file`, for anything else, files cut short among
/// them. Memory stays below twice the size of the file.
ImportResult read_stl(std::string_view bytes, const std::string& file);

}  // namespace lamina::engine
