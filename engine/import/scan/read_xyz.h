#pragma once

#include <string>
#include <string_view>

#include "engine/import/import_result.h"

namespace lamina::engine {

/// Whether bytes are the beginning of a XYZ file.
bool looks_like_xyz(std::string_view bytes);

/// Reads a text of points, one a line: x y z, perhaps nx ny nz behind, parted by blanks, commas or
/// semicolons. Three further columns that are no unit vectors, such as colours, are passed over, as are
/// comments and a line with the number of points. Lengths count as mm. Throws ImportError.
ImportResult read_xyz(std::string_view bytes, const std::string& file);

}  // namespace lamina::engine
