// What the firmware tells, its settings for talking, and what it takes without doing anything.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "transport/emulator/program_maker.h"

namespace lamina::transport {

bool ProgramMaker::report_code() {
  switch (command_.code) {
    case 31:
      say(fmt::format("echo:Print time: {:.0f}s\n", to_seconds(now_.time_since_epoch())));
      return true;
    case 110:
      program_.new_last_line = command_.integer('N');
      return true;
    case 112:
      add(KillStep{});
      return true;
    case 113:
      if (const auto seconds = command_.value('S')) {
        settings_.busy_interval = from_seconds(std::clamp(*seconds, 0.0, 60.0));
      } else {
        say(fmt::format("echo:M113 S{:.0f}\n", to_seconds(settings_.busy_interval)));
      }
      return true;
    case 114:
      add(PositionStep{});
      return true;
    case 115:
      say(capabilities());
      return true;
    case 118:
      say(fmt::format("{}\r\n", host_message()));
      return true;
    case 119:
      say("Reporting endstop status\nx_min: open\ny_min: open\nz_min: open\n");
      return true;
    case 154:
      settings_.position_interval = from_seconds(std::clamp(value('S', 0), 0.0, 60.0));
      return options_.features.auto_report;
    case 155:
      settings_.temperature_interval = from_seconds(std::clamp(value('S', 0), 0.0, 60.0));
      return options_.features.auto_report;
    case 500:
      say("echo:Settings Stored (624 bytes; crc 6831)\n");
      return true;
    case 999:
      program_.request_resend = !command_.has('S') || value('S', 1) == 0;
      return true;
    default:
      return false;
  }
}

/// M118 [E1] [A1] text
std::string ProgramMaker::host_message() const {
  std::string_view text = command_.string;
  std::string prefix;
  while (text.size() > 2 && (text[0] == 'E' || text[0] == 'A') && text[1] == '1' && text[2] == ' ') {
    prefix += text[0] == 'E' ? "echo:" : "//";
    text.remove_prefix(3);
  }
  return fmt::format("{}{}", prefix, text);
}

std::string ProgramMaker::capabilities() const {
  const FirmwareFeatures& features = options_.features;
  std::string text = fmt::format(
      "FIRMWARE_NAME:Marlin 2.1.2.1 (emulated by lamina) SOURCE_CODE_URL:github.com/MarlinFirmware/Marlin "
      "PROTOCOL_VERSION:1.0 MACHINE_TYPE:{} EXTRUDER_COUNT:1 UUID:00000000-0000-0000-0000-000000000000\n",
      options_.machine_name);
  const std::initializer_list<std::pair<const char*, bool>> capabilities{
      {"SERIAL_XON_XOFF", false},
      {"BINARY_FILE_TRANSFER", false},
      {"EEPROM", false},
      {"VOLUMETRIC", true},
      {"AUTOREPORT_POS", features.auto_report},
      {"AUTOREPORT_TEMP", features.auto_report},
      {"PROGRESS", false},
      {"PRINT_JOB", true},
      {"AUTOLEVEL", features.leveling},
      {"RUNOUT", false},
      {"Z_PROBE", features.leveling},
      {"LEVELING_DATA", features.leveling},
      {"BUILD_PERCENT", false},
      {"SOFTWARE_POWER", false},
      {"TOGGLE_LIGHTS", false},
      {"CASE_LIGHT_BRIGHTNESS", false},
      {"EMERGENCY_PARSER", features.emergency_parser},
      {"HOST_ACTION_COMMANDS", features.host_actions},
      {"PROMPT_SUPPORT", features.host_actions},
      {"SDCARD", features.sd_card},
      {"REPEAT", false},
      {"SD_WRITE", features.sd_card},
      {"AUTOREPORT_SD_STATUS", features.sd_card},
      {"LONG_FILENAME", false},
      {"LFN_WRITE", false},
      {"CUSTOM_FIRMWARE_UPLOAD", false},
      {"EXTENDED_M20", false},
      {"THERMAL_PROTECTION", true},
      {"MOTION_MODES", false},
      {"ARCS", features.arcs},
      {"BABYSTEPPING", false},
      {"CHAMBER_TEMPERATURE", false},
      {"COOLER_TEMPERATURE", false},
      {"MEATPACK", features.meatpack},
      {"CONFIG_EXPORT", false}};
  for (const auto& [name, present] : capabilities) {
    const auto claim = options_.claims.find(name);
    const bool says = claim == options_.claims.end() ? present : claim->second;
    text += fmt::format("Cap:{}:{}\n", name, says ? 1 : 0);
  }
  const auto& low = options_.motion.bed_min;
  const auto& high = options_.motion.bed_max;
  const std::string box =
      fmt::format("{{min:{{x:{:.2f},y:{:.2f},z:{:.2f}}},max:{{x:{:.2f},y:{:.2f},z:{:.2f}}}}}", low[0], low[1],
                  low[2], high[0], high[1], high[2]);
  return text + fmt::format("area:{{full:{},work:{}}}\n", box, box);
}

/// Commands that a stock build knows and that change nothing here.
bool ProgramMaker::quiet_code() const {
  constexpr std::array kQuiet{75,  76,  77,  92,  108, 111, 117, 200, 206, 301,
                              302, 304, 410, 501, 502, 503, 900, 413, 412};
  return std::find(kQuiet.begin(), kQuiet.end(), command_.code) != kQuiet.end();
}

bool ProgramMaker::tool() {
  if (command_.code != 0) say(fmt::format("echo:T{} Invalid extruder\n", command_.code));
  return true;
}

}  // namespace lamina::transport
