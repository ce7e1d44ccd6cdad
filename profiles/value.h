#pragma once

#include <cstdint>
#include <string>
#include <variant>

namespace lamina::profiles {

/// A value as a profile file or the command line gives it.
using Value = std::variant<bool, std::int64_t, double, std::string>;

/// The value as it would stand in a TOML file: numbers in the shortest form that reads back equal, strings in
/// quotes with \n, \t, \" and \\ escaped, so that it never spans lines.
std::string to_toml(const Value& value);

/// A number in the shortest form that reads back equal, without an exponent where it is between 1e-6 and
/// 1e15.
std::string number_text(double number);

}  // namespace lamina::profiles
