#include "transport/protocol/meatpack.h"

#include <cassert>

namespace lamina::transport::meatpack {

namespace {

/// G and one of these is a move.
constexpr std::string_view kMoves = "01235";

unsigned half_byte(char c, bool no_spaces) {
  const std::size_t at = alphabet(no_spaces).find(c);
  return at == std::string_view::npos ? kLiteral : static_cast<unsigned>(at);
}

}  // namespace

std::string_view alphabet(bool no_spaces) {
  return no_spaces ? "0123456789.E\nGX" : "0123456789. \nGX";
}

std::string control(char code) {
  return {kSignal, kSignal, code};
}

std::string start(bool no_spaces) {
  return control(kResetAll) + control(no_spaces ? kNoSpaces : kWithSpaces) + control(kEnable);
}

std::string pack(std::string_view lines, bool no_spaces, const std::vector<bool>& wide) {
  std::string packed;
  bool begins = true;
  for (std::size_t pair = 0; !lines.empty(); ++pair) {
    const char first_char = lines.front();
    lines.remove_prefix(1);
    assert(first_char != kSignal);
    if (first_char == '\n') {
      // What stands beside a line end is not looked at.
      packed += static_cast<char>(kLineEnd | kLineEnd << 4);
      begins = true;
      continue;
    }
    // A text without an end of its own gets one.
    const char second_char = lines.empty() ? '\n' : lines.front();
    if (!lines.empty()) lines.remove_prefix(1);
    assert(second_char != kSignal);
    const bool may_become_move =
        begins && first_char == 'N' && kMoves.find(second_char) != std::string_view::npos;
    const bool is_wide = first_char == '-' || (pair < wide.size() && wide[pair]);
    const bool apart = second_char == first_char || may_become_move || is_wide;
    const unsigned first = is_wide ? kLiteral : half_byte(first_char, no_spaces);
    const unsigned second = apart ? kLiteral : half_byte(second_char, no_spaces);
    begins = second_char == '\n';
    packed += static_cast<char>(first | second << 4);
    if (first == kLiteral) packed += first_char;
    if (second == kLiteral) packed += second_char;
  }
  return packed;
}

std::size_t pair_bytes(char byte) {
  const unsigned first = static_cast<unsigned char>(byte) & 0xFU;
  const unsigned second = static_cast<unsigned char>(byte) >> 4U;
  if (first == kLineEnd) return 1;
  return 1U + (first == kLiteral ? 1 : 0) + (second == kLiteral ? 1 : 0);
}

bool ends_line(char byte) {
  const auto value = static_cast<unsigned char>(byte);
  return (value & 0xFU) == kLineEnd || value >> 4U == kLineEnd;
}

}  // namespace lamina::transport::meatpack
