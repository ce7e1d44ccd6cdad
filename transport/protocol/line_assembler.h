#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace lamina::transport {

/// Marlin's way from bytes to lines: ends are \n and \r, empty lines vanish, `;` drops the rest, `\` takes
/// the next byte as it is (and is dropped itself), a backspace deletes, what is longer than the buffer is cut
/// off silently.
class LineAssembler {
 public:
  explicit LineAssembler(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// Takes one byte; the line, without leading blanks, if this byte ended one.
  std::optional<std::string> push(char byte);

  /// Forgets the half line.
  void clear();

 private:
  std::size_t max_bytes_;
  std::string line_;
  bool in_comment_ = false;
  bool escaped_ = false;
};

}  // namespace lamina::transport
