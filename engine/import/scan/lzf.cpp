#include "engine/import/scan/lzf.h"

namespace lamina::engine {

/// A control byte below 32 announces one more literal bytes than it says; others repeat what lies up to 8192
/// bytes back, three bytes at least: the upper three bits are the length less two, 7 that one more byte is
/// added to it; the lower five bits and a byte behind are the way back less one.
std::optional<std::string> inflate_lzf(std::string_view bytes, std::size_t size) {
  std::string result;
  result.reserve(size);
  std::size_t at = 0;
  const auto next = [&] { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[at++])); };
  while (at < bytes.size()) {
    const std::size_t control = next();
    if (control < 32) {
      const std::size_t count = control + 1;
      if (count > bytes.size() - at || count > size - result.size()) return std::nullopt;
      result.append(bytes.substr(at, count));
      at += count;
      continue;
    }
    std::size_t count = (control >> 5U) + 2;
    if (count == 9) {
      if (at == bytes.size()) return std::nullopt;
      count += next();
    }
    if (at == bytes.size()) return std::nullopt;
    const std::size_t back = ((control & 31U) << 8U) + next() + 1;
    if (back > result.size() || count > size - result.size()) return std::nullopt;
    // What is repeated may overlap what is made.
    for (std::size_t k = 0; k < count; ++k) result.push_back(result[result.size() - back]);
  }
  if (result.size() != size) return std::nullopt;
  return result;
}

}  // namespace lamina::engine
