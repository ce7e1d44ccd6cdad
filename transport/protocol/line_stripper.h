#pragma once

#include <string>
#include <string_view>

namespace lamina::transport {

/// What the printer needs of a line of a G-code file: no comment (`;...` and `(...)`), no line number and
/// checksum of its own, no blanks at the ends, runs of blanks as one, command letter and parameters in upper
/// case. Empty when nothing is left. The text of a command that takes one (M117, M118, M23, M28 and the like)
/// is kept as written, up to a comment; a message (M117, M118) is cut to what fits on a numbered line. Bytes
/// that the firmware would take out before it looks at the checksum (backslash, backspace and other control
/// characters) are left away.
std::string strip_line(std::string_view line);

}  // namespace lamina::transport
