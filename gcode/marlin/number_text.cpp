#include "gcode/marlin/number_text.h"

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace lamina::gcode {
namespace {

/// The longest finite double without an exponent: 309 digits before the point, 1074 after it, sign and point.
using Buffer = std::array<char, 1400>;

}  // namespace

double rounded(double value, int decimals) {
  assert(std::isfinite(value));
  static constexpr std::array<double, 10> kPowers{1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
  const double power = kPowers.at(static_cast<std::size_t>(decimals));
  // Both operands of the division are exact, so the quotient is the double nearest to the decimal fraction
  // and its shortest text has no more decimals.
  return std::round(value * power) / power + 0.0;
}

std::string number_text(double value, int decimals) {
  return exact_text(rounded(value, decimals));
}

std::string exact_text(double value) {
  if (value == 0.0) return "0";
  Buffer buffer{};
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed);
  assert(error == std::errc());
  return {buffer.data(), end};
}

std::string fixed_text(double value, int decimals) {
  Buffer buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(),
                                          rounded(value, decimals), std::chars_format::fixed, decimals);
  assert(error == std::errc());
  return {buffer.data(), end};
}

std::optional<ReadNumber> read_number(std::string_view text) {
  // from_chars takes no leading plus sign, and "inf" and "nan", which are no G-code numbers.
  const std::size_t sign = !text.empty() && (text.front() == '+' || text.front() == '-') ? 1 : 0;
  if (sign == text.size()) return std::nullopt;
  const char first = text[sign];
  if (first != '.' && (first < '0' || first > '9')) return std::nullopt;
  double value = 0.0;
  const auto [end, error] =
      std::from_chars(text.data() + sign, text.data() + text.size(), value, std::chars_format::fixed);
  if (error != std::errc()) return std::nullopt;
  if (text.front() == '-') value = -value;
  return ReadNumber{value + 0.0, static_cast<std::size_t>(end - text.data())};
}

}  // namespace lamina::gcode
