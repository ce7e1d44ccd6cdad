#pragma once

#include <charconv>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace lamina::engine {

/// Walks through a text by words, and counts its lines. Words are what blanks (space, tab, CR) part.
class TextCursor {
 public:
  explicit TextCursor(std::string_view text) : text_(text) {}

  /// The next word of the present line; empty where the line ends.
  std::string_view word() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    const std::size_t first = at_;
    while (at_ < text_.size() && text_[at_] != '\n' && !is_blank(text_[at_])) ++at_;
    return text_.substr(first, at_ - first);
  }

  /// The next word of this or a later line; empty at the end of the text.
  std::string_view word_across_lines() {
    while (true) {
      const std::string_view found = word();
      if (!found.empty() || !next_line()) return found;
    }
  }

  /// Passes over the rest of the line and its end. False where the text ends.
  bool next_line() {
    const std::size_t end = text_.find('\n', at_);
    at_ = end == std::string_view::npos ? text_.size() : end + 1;
    ++line_;
    return at_ < text_.size();
  }

  std::size_t line() const { return line_; }  ///< from 1

  /// What has not been passed yet.
  std::string_view rest() const { return text_.substr(at_); }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

/// The number that the whole word spells, a plus sign allowed; infinities and NaN too. Nothing otherwise.
/// What is too small or too large for the type is 0 or infinite.
template <typename Number>
std::optional<Number> parse_number(std::string_view word) {
  if (word.substr(0, 1) == "+" && word.substr(1, 1) != "-") word.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || word.empty()) return std::nullopt;
  if constexpr (!std::is_integral_v<Number>) {
    if (error == std::errc::result_out_of_range) {
      const auto exponent = word.find_first_of("eE");
      const bool is_tiny = exponent != std::string_view::npos && word.substr(exponent + 1, 1) == "-";
      return is_tiny ? Number{0} : std::numeric_limits<Number>::infinity();
    }
  }
  if (error != std::errc()) return std::nullopt;
  return value;
}

}  // namespace lamina::engine
