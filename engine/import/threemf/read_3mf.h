#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/import/import_result.h"

namespace lamina::engine {

/// Whether the bytes are a ZIP archive.
bool looks_like_zip(std::string_view bytes);

/// Reads a 3MF package (3MF Core Specification 1.2): every item of the build becomes a mesh in mm, with the
/// placements of the item and of its components applied, in the order of the file. Components may lie in
/// other model parts (Production Extension). Items that are not printable and support objects are left out
/// and reported; materials, slices and other extensions are passed over. Throws ImportError, naming `file`,
/// where the package is damaged, an index leads nowhere, objects contain each other, or there is nothing to
/// slice. The archive may inflate to at most `max_bytes`; memory stays below twice that of the meshes.
ImportResult read_3mf(std::string_view bytes, const std::string& file, std::size_t max_bytes);

}  // namespace lamina::engine
