#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace lamina::gcode {

/// A letter and, mostly, a number: X12.5, or the bare X of "G28 X".
struct Word {
  char letter = 'X';
  std::optional<double> value;

  bool operator==(const Word&) const = default;
};

/// What a line tells the machine to do: G1, M104, T0, G92.1.
struct Command {
  char letter = 'G';
  int number = 0;
  std::optional<int> subcode;

  bool operator==(const Command&) const = default;
};

/// One line of a G-code file: a command with its words in the order written, a comment, both or nothing.
/// Commands that take a text (M117, M118, M23, ...) have it in `argument` and no words.
struct GcodeLine {
  std::optional<Command> command;
  std::vector<Word> words;
  std::string argument;
  std::optional<std::string> comment;  ///< Everything after the semicolon.

  bool operator==(const GcodeLine&) const = default;

  bool is(char letter, int number) const;

  /// The value of the first word with this letter; nothing when there is none or it is bare.
  std::optional<double> value(char letter) const;

  /// In canonical form, without a line feed: upper case, single spaces, numbers with as many decimals as they
  /// need, no exponent, no "-0". parse_line(text()) gives back the same value.
  std::string text() const;
};

/// A line that is no G-code.
class GcodeError : public std::runtime_error {
 public:
  GcodeError(std::size_t line_number, std::size_t column_number, const std::string& problem);

  std::size_t line;    ///< 1-based; 0 when the line stands alone.
  std::size_t column;  ///< 1-based
};

/// Reads one line without its line feed; spaces and letter case do not matter. `number` of the line is for
/// the message of a GcodeError. Line numbers and checksums belong to the wire and are refused.
GcodeLine parse_line(std::string_view text, std::size_t number = 0);

}  // namespace lamina::gcode
