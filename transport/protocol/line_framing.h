#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace lamina::transport {

/// The number of a line on the wire. Marlin counts with a signed long.
using LineNumber = std::int64_t;

/// What Marlin keeps of a line without its end (MAX_CMD_SIZE 96 less the NUL). The rest would be cut
/// silently.
inline constexpr std::size_t kMaxLineBytes = 95;

/// A line that cannot go over the wire as it is.
class LineError : public std::runtime_error {
 public:
  LineError(std::string text, std::size_t bytes, std::size_t bound);

  std::string text;
  std::size_t bytes;  ///< with number and checksum
  std::size_t bound;
};

/// Exclusive or of all bytes of `text`. Marlin takes it over everything from the N up to, without, the last
/// '*'.
std::uint8_t checksum(std::string_view text);

/// How number and command are put together.
struct LineFrame {
  bool blank = true;  ///< between them
  /// A zero before a number of an odd count of digits. Packed two to a byte, the number's last digit and the
  /// command's G then share one, so that the firmware's error flush cannot cut a line in front of its G.
  bool even_digits = false;
  /// The other way round.
  bool odd_digits = false;
};

/// `command` as a numbered line with checksum and line end: "N3 G1 X50*5\n". Throws LineError if it would
/// have more than kMaxLineBytes without the end.
std::string frame_line(LineNumber number, std::string_view command, LineFrame frame = {});

}  // namespace lamina::transport
