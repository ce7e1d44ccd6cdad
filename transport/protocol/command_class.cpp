#include "transport/protocol/command_class.h"

#include <algorithm>
#include <array>

namespace lamina::transport {

CommandClass classify(std::string_view command) {
  constexpr std::array<std::string_view, 5> kMotion{"G0", "G1", "G2", "G3", "G5"};
  constexpr std::array<std::string_view, 25> kBlocking{
      "G4",  "G12",  "G27",  "G28",  "G29",  "G30",  "G32",  "G33",  "G34",  "G35",  "G76",  "M0",  "M1",
      "M48", "M109", "M116", "M125", "M190", "M191", "M226", "M303", "M400", "M600", "M701", "M702"};
  const std::string_view word = command_word(command);
  const auto is_in = [word](const auto& words) {
    return std::find(words.begin(), words.end(), word) != words.end();
  };
  if (is_in(kMotion)) return CommandClass::kMotion;
  if (is_in(kBlocking)) return CommandClass::kBlocking;
  return CommandClass::kQuick;
}

std::string_view command_word(std::string_view command) {
  if (command.empty()) return {};
  std::size_t end = 1;
  while (end < command.size() && command[end] >= '0' && command[end] <= '9') ++end;
  return end == 1 ? std::string_view{} : command.substr(0, end);
}

}  // namespace lamina::transport
