#include "transport/protocol/line_framing.h"

#include <utility>

#include <fmt/format.h>

namespace lamina::transport {

LineError::LineError(std::string line, std::size_t size, std::size_t limit)
    : std::runtime_error(fmt::format(
          "line too long for the printer: {} bytes with number and checksum, {} allowed: {}; shorten it",
          size, limit, line)),
      text(std::move(line)),
      bytes(size),
      bound(limit) {}

std::uint8_t checksum(std::string_view text) {
  std::uint8_t sum = 0;
  for (const char byte : text) sum = static_cast<std::uint8_t>(sum ^ static_cast<std::uint8_t>(byte));
  return sum;
}

std::string frame_line(LineNumber number, std::string_view command, LineFrame frame) {
  std::string digits = fmt::format("{}", number);
  const bool is_even = digits.size() % 2 == 0;
  const bool pads = (frame.even_digits && !is_even) || (frame.odd_digits && is_even);
  if (pads && number >= 0) digits.insert(0, 1, '0');
  std::string line = fmt::format("N{}{}{}", digits, frame.blank ? " " : "", command);
  line += fmt::format("*{}", checksum(line));
  if (line.size() > kMaxLineBytes) throw LineError(std::string(command), line.size(), kMaxLineBytes);
  line += '\n';
  return line;
}

}  // namespace lamina::transport
