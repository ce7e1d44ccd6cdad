#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/import/import_result.h"

namespace lamina::engine {

/// Whether bytes are the beginning of a PCD file.
bool looks_like_pcd(std::string_view bytes);

/// Reads a scan in the format of the Point Cloud Library, version 0.7: ascii, binary or binary_compressed.
/// Lengths count as mm. What is compressed may inflate to at most `max_bytes`. Throws ImportError.
ImportResult read_pcd(std::string_view bytes, const std::string& file, std::size_t max_bytes);

}  // namespace lamina::engine
