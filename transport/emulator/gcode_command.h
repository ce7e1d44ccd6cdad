#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace lamina::transport {

/// A command as Marlin's parser takes it apart.
struct GcodeCommand {
  char letter = '?';  ///< G, M, T; '?' for what is none of them
  int code = 0;
  std::string text;    ///< the whole command, without line number and checksum
  std::string string;  ///< what follows the code, as written: the argument of M117 and M118

  /// `parameter` (an upper-case letter) was given, with or without a value.
  bool has(char parameter) const { return seen[index(parameter)]; }

  /// The value of `parameter`; none if it was not given, or without a number.
  std::optional<double> value(char parameter) const { return values[index(parameter)]; }

  /// The same as a whole number, cut off towards zero and at the ends of what an int holds.
  std::optional<int> integer(char parameter) const;

  std::array<bool, 26> seen{};
  std::array<std::optional<double>, 26> values{};

 private:
  static std::size_t index(char parameter) { return static_cast<std::size_t>(parameter - 'A'); }
};

/// Takes apart one accepted line. Blanks between parameters are optional, E is never an exponent.
GcodeCommand parse_gcode_command(std::string_view line);

}  // namespace lamina::transport
