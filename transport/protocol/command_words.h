#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lamina::transport {

/// A stripped command taken apart as far as a host needs it: its code ("G1") and the numbers behind letters.
class CommandWords {
 public:
  explicit CommandWords(std::string_view command);

  /// "G1", "M104", "T0"; empty if the command has none.
  std::string_view code() const { return code_; }

  /// The number behind `letter` (upper case); none if the letter is missing or has no number.
  std::optional<double> number(char letter) const;

  /// `letter` is there, with or without a number.
  bool has(char letter) const;

  /// What follows the code.
  std::string_view rest() const { return rest_; }

 private:
  std::string_view code_;
  std::string_view rest_;
};

/// A number as a command carries it: at most five decimals, no exponent, no needless zeros, whatever the
/// locale.
std::string number_text(double value);

/// " X12.5": a blank, the letter, the number.
std::string word_text(char letter, double value);

}  // namespace lamina::transport
