#pragma once

#include <string>
#include <string_view>

namespace lamina::transport {

/// How a command is written on the wire. Neither changes what the firmware reads. Without blanks the line is
/// a tenth shorter, and the tail of a line that the firmware's error flush has cut is a command of its own
/// only where it is cut at one place, in front of the G, instead of two.
struct LineForm {
  bool short_numbers = true;  ///< no zeros and signs that say nothing: "-0.500" is "-.5", "+010.0" is "10"
  bool blanks = false;        ///< keep the blanks between words
};

/// `command`, as strip_line gives it, in that form. A command that takes text, or that has anything in it but
/// words of a letter and a number, is left as it is.
std::string wire_form(std::string_view command, const LineForm& form);

}  // namespace lamina::transport
