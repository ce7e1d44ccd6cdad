#include "transport/emulator/emergency_parser.h"

#include <utility>

namespace lamina::transport {

namespace {

/// Enough for "N-2000000000 M876 S1".
constexpr std::size_t kLongestPrefix = 24;

std::string without_number(const std::string& line) {
  std::size_t at = line.find_first_not_of(' ');
  if (at == std::string::npos) return {};
  if (line[at] == 'N') {
    at = line.find_first_not_of("-0123456789", at + 1);
    if (at == std::string::npos) return {};
    at = line.find_first_not_of(' ', at);
  }
  return at == std::string::npos ? std::string{} : line.substr(at);
}

}  // namespace

std::optional<EmergencyCommand> early_command(const std::string& line) {
  if (line.starts_with("M112")) return EmergencyCommand::kKill;
  if (line.starts_with("M108")) return EmergencyCommand::kBreakWaits;
  if (line.starts_with("M410")) return EmergencyCommand::kQuickStop;
  return std::nullopt;
}

std::optional<EmergencyCommand> EmergencyParser::push(char byte) {
  if (byte == '\n' || byte == '\r') {
    const std::string line = without_number(std::exchange(line_, {}));
    if (line.starts_with("M524")) return EmergencyCommand::kAbortCard;
    if (line.starts_with("M876 S") || line.starts_with("M876S")) return EmergencyCommand::kAnswer;
    return early_command(line);
  }
  if (line_.size() < kLongestPrefix) line_ += byte;
  return std::nullopt;
}

}  // namespace lamina::transport
