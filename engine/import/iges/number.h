#pragma once

#include <optional>
#include <string_view>

namespace lamina::engine {

/// The integer that the whole text spells, a sign allowed.
std::optional<int> parse_integer(std::string_view text);

/// The real number that the whole text spells, with or without a decimal point, with an exponent after E or D
/// of either case. Nothing for infinities, NaN and numbers too large; numbers too small become zero.
std::optional<double> parse_real(std::string_view text);

/// `text` without blanks at either end.
std::string_view trimmed(std::string_view text);

}  // namespace lamina::engine
