#pragma once

#include <optional>
#include <string>

namespace lamina::transport {

/// Commands that act as soon as they are received, whatever the command queue holds.
enum class EmergencyCommand { kKill, kBreakWaits, kQuickStop, kAbortCard, kAnswer };

/// Which of M112, M108 and M410 `line` begins with: what acts when it is read even without an emergency
/// parser. More digits do not matter (M1125 kills), a line number does.
std::optional<EmergencyCommand> early_command(const std::string& line);

/// Marlin's emergency parser: watches the bytes as they arrive for M112, M108, M410, M524 and M876 S. The
/// command must begin the line, behind an optional line number; it acts at the line's end; number and
/// checksum are not looked at.
class EmergencyParser {
 public:
  std::optional<EmergencyCommand> push(char byte);

 private:
  std::string line_;
};

}  // namespace lamina::transport
