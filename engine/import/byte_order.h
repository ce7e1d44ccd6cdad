#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace lamina::engine {

/// The number that starts at `bytes` in the given byte order.
template <typename Number>
Number load(const char* bytes, std::endian order) {
  std::array<char, sizeof(Number)> buffer;
  std::copy_n(bytes, sizeof(Number), buffer.begin());
  if (order != std::endian::native) std::reverse(buffer.begin(), buffer.end());
  return std::bit_cast<Number>(buffer);
}

}  // namespace lamina::engine
