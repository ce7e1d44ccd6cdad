#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lamina::engine {

/// What `bytes`, compressed by LZF (Lehmann), mean: exactly `size` bytes, or nothing.
std::optional<std::string> inflate_lzf(std::string_view bytes, std::size_t size);

/// No byte of LZF stands for more.
inline constexpr std::size_t kMostLzfBytes = 88;

}  // namespace lamina::engine
