#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "transport/protocol/line_framing.h"

namespace lamina::transport {

/// `line`, as frame_line gives it for `number`, packed (see meatpack.h) so that no damage to one byte of it
/// gets past the firmware: every bit that may be turned over, and every byte that may be lost, is tried on
/// the firmware's way of reading, and what would then run in the line's place, or as a move without a number,
/// is packed wider there. None where that does not help, which is rare; such a line cannot be packed.
///
/// What is left: a byte too many that stands for two equal characters, between any two bytes of the line. The
/// firmware's checksum is an exclusive or, which two equal characters leave as it is. That holds for one in
/// 29 bytes of any value put in anywhere, and for one in two thousand bytes that come twice. And damage to
/// two bytes of one line, as without packing.
std::optional<std::string> packed_line(std::string_view line, LineNumber number, bool no_spaces);

}  // namespace lamina::transport
