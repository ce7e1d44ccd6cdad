#pragma once

#include <cstddef>
#include <filesystem>

#include "engine/import/import_result.h"

namespace lamina::engine {

/// Reads a model file: IGES as .igs or .iges, plain or gzip (told apart by content, whatever the name). The
/// model is named after the file's stem. A gzip file may inflate to at most `max_bytes`. Throws ImportError
/// where the file cannot be opened, is of another format or cannot be read.
ImportResult read_model(const std::filesystem::path& path, std::size_t max_bytes = std::size_t{1} << 30);

}  // namespace lamina::engine
