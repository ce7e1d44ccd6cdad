#include "transport/emulator/command_program.h"

#include <fmt/format.h>

#include "transport/emulator/program_maker.h"

namespace lamina::transport {

CommandProgram ProgramMaker::make() {
  bool known = false;
  if (command_.letter == 'G') known = g_code();
  if (command_.letter == 'M') {
    known = motion_code() || limit_code() || temperature_code() || report_code() || user_code() ||
            card_code() || quiet_code();
  }
  if (command_.letter == 'T') known = tool();
  if (!known) {
    ++machine_.record().report().unknown_commands;
    say(fmt::format("echo:Unknown command: \"{}\"\n", command_.text));
  }
  return std::move(program_);
}

CommandProgram make_program(const GcodeCommand& command, const Firmware& firmware) {
  return ProgramMaker(command, firmware).make();
}

}  // namespace lamina::transport
