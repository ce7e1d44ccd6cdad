// Heaters and fans.

#include <fmt/format.h>

#include "transport/emulator/program_maker.h"

namespace lamina::transport {

bool ProgramMaker::temperature_code() {
  switch (command_.code) {
    case 104:
    case 109: {
      if (const double wanted = value('T', 0); wanted != 0) {
        say(fmt::format("echo:M{} Invalid extruder {:.0f}\n", command_.code, wanted));
        return true;
      }
      set_target(machine_.hotend());
      if (command_.code == 109) add(HeatStep{HeaterName::kHotend, command_.has('R')});
      return true;
    }
    case 105:
      say(fmt::format("ok{}\n", machine_.temperatures()));
      program_.acknowledged = false;
      return true;
    case 106:
    case 107:
      return true;
    case 140:
    case 190:
      set_target(machine_.bed());
      if (command_.code == 190) add(HeatStep{HeaterName::kBed, command_.has('R')});
      return true;
    default:
      return false;
  }
}

void ProgramMaker::set_target(Heater& heater) const {
  if (const auto target = command_.value('S')) heater.set_target(*target);
  if (const auto target = command_.value('R')) heater.set_target(*target);
}

}  // namespace lamina::transport
