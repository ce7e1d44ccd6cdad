#pragma once

#include <cstddef>
#include <filesystem>

#include "engine/import/import_result.h"

namespace lamina::engine {

/// Reads a model file: IGES, STEP (where OpenCASCADE was found), STL, OBJ, 3MF, PLY, PCD or XYZ, plain or
/// gzip. What a file is, its content says first, then its extension. The model is named after the file's
/// stem. A gzip file or a 3MF package may inflate to at most `max_bytes`. Throws ImportError where the file
/// cannot be opened, is of another format or cannot be read.
ImportResult read_model(const std::filesystem::path& path, std::size_t max_bytes = std::size_t{1} << 30);

}  // namespace lamina::engine
