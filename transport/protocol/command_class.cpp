#include "transport/protocol/command_class.h"

#include <algorithm>
#include <array>
#include <charconv>

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

bool takes_text(std::string_view command) {
  constexpr std::array kTextCodes{0,   1,   16,  20,  23,  28,  30,  32,  33,  36,  98, 117,
                                  118, 486, 550, 551, 552, 587, 588, 589, 808, 862, 928};
  if (command.empty() || (command.front() != 'M' && command.front() != 'm')) return false;
  int code = 0;
  const auto [end, error] = std::from_chars(command.data() + 1, command.data() + command.size(), code);
  return error == std::errc() && std::find(kTextCodes.begin(), kTextCodes.end(), code) != kTextCodes.end();
}

}  // namespace lamina::transport
