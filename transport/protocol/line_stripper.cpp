#include "transport/protocol/line_stripper.h"

#include <algorithm>

#include "transport/protocol/command_class.h"

namespace lamina::transport {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Without "N12 " in front and "*71" behind.
std::string_view without_frame(std::string_view text) {
  if (text.size() < 2 || upper(text.front()) != 'N' || !(is_digit(text[1]) || text[1] == '-')) return text;
  text.remove_prefix(2);
  while (!text.empty() && is_digit(text.front())) text.remove_prefix(1);
  const std::size_t star = text.rfind('*');
  return trim(star == std::string_view::npos ? text : text.substr(0, star));
}

/// Bytes that Marlin's line reader, or its unpacker, acts on instead of keeping them.
bool is_harmful(char c) {
  return c == '\\' || (c >= 0 && c < ' ' && c != '\t') || c == 0x7f || c == '\xFF';
}

/// A message that leaves room for a ten-digit line number and the checksum.
constexpr std::size_t kMaxMessageBytes = 79;

}  // namespace

std::string strip_line(std::string_view line) {
  std::string_view text = trim(line.substr(0, line.find(';')));
  text = without_frame(text);
  std::string stripped;
  if (takes_text(text)) {
    stripped = text;
    std::erase_if(stripped, is_harmful);
    stripped.front() = upper(stripped.front());
    const std::string_view word = command_word(stripped);
    if ((word == "M117" || word == "M118") && stripped.size() > kMaxMessageBytes)
      stripped.resize(kMaxMessageBytes);
    return std::string(trim(stripped));
  }
  bool in_comment = false;
  bool pending_blank = false;
  for (const char c : text) {
    if (c == '(') in_comment = true;
    if (!in_comment && is_blank(c)) pending_blank = true;
    if (!in_comment && !is_blank(c) && !is_harmful(c)) {
      if (pending_blank && !stripped.empty()) stripped += ' ';
      pending_blank = false;
      stripped += upper(c);
    }
    if (c == ')') in_comment = false;
  }
  return stripped;
}

}  // namespace lamina::transport
