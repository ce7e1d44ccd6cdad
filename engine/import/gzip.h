#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lamina::engine {

/// Whether the bytes start like a gzip file (RFC 1952).
bool is_gzip(std::string_view bytes);

/// The content of a gzip file, all its members in turn. Throws ImportError, naming `file`, where it is
/// damaged, cut short, or would inflate to more than `max_bytes`.
std::string inflate_gzip(std::string_view bytes, const std::string& file, std::size_t max_bytes);

}  // namespace lamina::engine
