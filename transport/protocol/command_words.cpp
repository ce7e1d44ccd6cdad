#include "transport/protocol/command_words.h"

#include <array>
#include <charconv>

#include "transport/protocol/command_class.h"

namespace lamina::transport {

CommandWords::CommandWords(std::string_view command)
    : code_(command_word(command)), rest_(command.substr(code_.size())) {}

std::optional<double> CommandWords::number(char letter) const {
  const std::size_t at = rest_.find(letter);
  if (at == std::string_view::npos) return std::nullopt;
  std::string_view digits = rest_.substr(at + 1);
  while (!digits.empty() && (digits.front() == ' ' || digits.front() == '+')) digits.remove_prefix(1);
  double value = 0;
  // Fixed: the E behind a number is the extruder, not an exponent.
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed);
  if (error != std::errc()) return std::nullopt;
  return value;
}

bool CommandWords::has(char letter) const {
  return rest_.find(letter) != std::string_view::npos;
}

std::string number_text(double value) {
  constexpr int kDecimals = 5;
  std::array<char, 400> digits{};
  const auto [end, error] =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, kDecimals);
  std::string text(digits.data(), end);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string word_text(char letter, double value) {
  return std::string{' ', letter} + number_text(value);
}

}  // namespace lamina::transport
