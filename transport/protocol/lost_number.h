#pragma once

#include <string>
#include <string_view>

#include "transport/protocol/line_history.h"
#include "transport/protocol/reply.h"

namespace lamina::transport {

/// A line that has lost exactly its number on the way, or got a line end behind it, is a command that the
/// firmware runs unchecked; then it asks for the line, which it says it never got. Most commands may run
/// twice. A move that extrudes must not: its end is where it was, but the plastic would come twice. So the
/// firmware is asked where it is (M114, which tells the end of the last move it has taken) before such a line
/// is sent again.

/// The error that made the firmware ask for a line may mean that its command has run all the same. Where a
/// line end has cut it off, its number stands without a checksum.
bool may_lack_number(std::string_view error);

/// Asks where the printer is, as a line that gives none of the numbers away: `last`, the last number that the
/// firmware has taken, is its own. Marlin takes a line with "M110" in it whatever its number is, as long as
/// the checksum fits, and goes on from that number; what it runs is the first command.
std::string place_question(LineNumber last);

enum class MoveTaken { kNo, kYes, kUnclear };

/// Line `number` extrudes, and where the printer is tells whether it was run: it is known from the lines
/// before it where it begins, to the hundredth of a mm that M114 tells, and it ends elsewhere.
bool tells_by_place(const LineHistory& history, LineNumber number);

/// Whether the printer that reports `place` has run line `number`, given that it has run all lines before it.
MoveTaken move_taken(const LineHistory& history, LineNumber number, const PositionReply& place);

}  // namespace lamina::transport
