#include "transport/emulator/gcode_command.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace lamina::transport {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

void skip_blanks(std::string_view& text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
}

void skip_digits(std::string_view& text) {
  while (!text.empty() && is_digit(text.front())) text.remove_prefix(1);
}

/// Whether a number begins here: a digit, perhaps behind a sign and a point. "nan" and "inf" are none.
bool begins_number(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  if (text.starts_with('.')) text.remove_prefix(1);
  return !text.empty() && is_digit(text.front());
}

/// The number at the start of `text`, taken off it.
std::optional<double> take_number(std::string_view& text) {
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  if (!begins_number(digits)) return std::nullopt;
  double value = 0;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

}  // namespace

std::optional<int> GcodeCommand::integer(char parameter) const {
  const std::optional<double> number = value(parameter);
  if (!number) return std::nullopt;
  constexpr double kLeast = std::numeric_limits<int>::min();
  constexpr double kMost = std::numeric_limits<int>::max();
  return static_cast<int>(std::clamp(*number, kLeast, kMost));
}

GcodeCommand parse_gcode_command(std::string_view line) {
  GcodeCommand command;
  skip_blanks(line);
  if (line.size() > 1 && line.front() == 'N' && (is_digit(line[1]) || line[1] == '-')) {
    line.remove_prefix(2);
    skip_digits(line);
    skip_blanks(line);
  }
  line = line.substr(0, line.find('*'));
  while (line.ends_with(' ')) line.remove_suffix(1);
  command.text = line;

  if (line.empty() || (line.front() != 'G' && line.front() != 'M' && line.front() != 'T')) return command;
  const char letter = line.front();
  line.remove_prefix(1);
  skip_blanks(line);
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), command.code);
  if (error != std::errc() || command.code < 0) return command;
  command.letter = letter;
  line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  skip_blanks(line);
  command.string = line;

  while (!line.empty()) {
    const char parameter = line.front();
    line.remove_prefix(1);
    if (parameter < 'A' || parameter > 'Z') continue;
    const auto at = static_cast<std::size_t>(parameter - 'A');
    command.seen[at] = true;
    skip_blanks(line);
    command.values[at] = take_number(line);
  }
  return command;
}

}  // namespace lamina::transport
