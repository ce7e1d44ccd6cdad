#include "transport/protocol/line_form.h"

#include <optional>

#include "transport/protocol/command_class.h"

namespace lamina::transport {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return c >= 'A' && c <= 'Z';
}

/// The number at the start of `text`, taken off it: "[+-]digits[.digits]" or "[+-].digits". Empty where there
/// is none; nothing where what is there is no number that the firmware would read to its end.
std::optional<std::string_view> take_number(std::string_view& text) {
  std::size_t at = 0;
  if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
  std::size_t digits = 0;
  while (at < text.size() && is_digit(text[at])) ++at, ++digits;
  if (at < text.size() && text[at] == '.') {
    ++at;
    while (at < text.size() && is_digit(text[at])) ++at, ++digits;
  }
  if (at > 0 && digits == 0) return std::nullopt;
  const std::string_view number = text.substr(0, at);
  text.remove_prefix(at);
  return number;
}

void trim_left(std::string_view& text, char c) {
  while (text.starts_with(c)) text.remove_prefix(1);
}

std::string shortened(std::string_view number) {
  if (number.empty()) return {};
  const bool negative = number.front() == '-';
  if (negative || number.front() == '+') number.remove_prefix(1);
  const std::size_t point = number.find('.');
  std::string_view whole = number.substr(0, point);
  std::string_view fraction = point == std::string_view::npos ? std::string_view{} : number.substr(point + 1);
  trim_left(whole, '0');
  while (fraction.ends_with('0')) fraction.remove_suffix(1);
  if (whole.empty() && fraction.empty()) return "0";
  std::string text = negative ? "-" : "";
  text += whole;
  if (!fraction.empty()) {
    text += '.';
    text += fraction;
  }
  return text;
}

}  // namespace

std::string wire_form(std::string_view command, const LineForm& form) {
  const std::string_view word = command_word(command);
  if (word.empty() || takes_text(command)) return std::string(command);
  std::string text;
  std::string_view rest = command;
  while (!rest.empty()) {
    const char letter = rest.front();
    rest.remove_prefix(1);
    if (letter == ' ') {
      if (form.blanks) text += ' ';
      continue;
    }
    if (!is_letter(letter)) return std::string(command);
    text += letter;
    const auto number = take_number(rest);
    if (!number) return std::string(command);
    text += form.short_numbers ? shortened(*number) : std::string(*number);
  }
  return text;
}

}  // namespace lamina::transport
