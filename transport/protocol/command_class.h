#pragma once

#include <string_view>

namespace lamina::transport {

/// How long the printer may take before it acknowledges a command.
enum class CommandClass {
  kQuick,     ///< answered when read: settings, reports
  kMotion,    ///< answered when it has a place in the planner; waits while that is full
  kBlocking,  ///< answered when done, minutes later perhaps: heating, homing, dwelling, waiting for the user
};

/// The class of a stripped command ("G1 X5", "M109 S210").
CommandClass classify(std::string_view command);

/// The command word of a stripped command: "G1" of "G1 X5" and of "G1X5". Empty if there is none.
std::string_view command_word(std::string_view command);

/// The command's parameter is text: a file name, a message for the display or for the host.
bool takes_text(std::string_view command);

}  // namespace lamina::transport
