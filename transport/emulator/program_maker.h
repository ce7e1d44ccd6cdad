#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "transport/emulator/command_program.h"

namespace lamina::transport {

/// One command at work: what it reads, and the program that it writes. Each group of commands has a file of
/// its own, and a function here that is true if it knows the command.
class ProgramMaker {
 public:
  ProgramMaker(const GcodeCommand& command, const Firmware& firmware)
      : command_(command),
        machine_(firmware.machine),
        settings_(firmware.settings),
        card_(firmware.card),
        options_(firmware.options),
        now_(firmware.now) {}

  CommandProgram make();

 private:
  void say(std::string text) { program_.steps.emplace_back(SayStep{std::move(text)}); }
  void add(Step step) { program_.steps.push_back(std::move(step)); }
  double value(char parameter, double otherwise) const {
    return command_.value(parameter).value_or(otherwise);
  }

  // program_motion.cpp
  bool g_code();
  void arc();
  void bezier();
  void follow(const std::vector<MachinePosition>& points);
  void home();
  void retract(bool back);
  void park();
  void level();
  bool motion_code();
  bool limit_code();

  // program_heat.cpp
  bool temperature_code();
  void set_target(Heater& heater) const;

  // program_report.cpp
  bool report_code();
  std::string host_message() const;
  std::string capabilities() const;
  bool quiet_code() const;
  bool tool();

  // program_user.cpp
  bool user_code();
  void user_stop();
  void change_filament();
  void cancel_objects();
  void prompt(const std::string& words, std::initializer_list<const char*> buttons);
  void wait_for_user(const std::string& words, std::initializer_list<const char*> buttons);

  // program_card.cpp
  bool card_code();
  void list_files();
  void select_file();

  const GcodeCommand& command_;
  Machine& machine_;
  HostSettings& settings_;
  SdCard& card_;
  const EmulatorOptions& options_;
  Instant now_;
  CommandProgram program_;
};

}  // namespace lamina::transport
