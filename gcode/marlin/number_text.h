#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lamina::gcode {

/// The number nearest to `value` with at most so many decimals (0 to 9), ties away from zero, never -0.
double rounded(double value, int decimals);

/// That number as text: no exponent, no trailing zeros, a zero before the point, no "-0", the point whatever
/// the locale. `value` must be finite.
std::string number_text(double value, int decimals);

/// The shortest text without an exponent that reads back as exactly this value; "0" for -0.
std::string exact_text(double value);

/// With exactly so many decimals.
std::string fixed_text(double value, int decimals);

/// The number that a text begins with, and how many characters it takes: digits with at most one point and a
/// sign, no exponent, nothing that is not finite. Nothing when it begins with no number.
struct ReadNumber {
  double value = 0.0;
  std::size_t size = 0;
};
std::optional<ReadNumber> read_number(std::string_view text);

}  // namespace lamina::gcode
