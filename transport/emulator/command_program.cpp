#include "transport/emulator/command_program.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "transport/emulator/curve_segments.h"

namespace lamina::transport {

namespace {

/// One command at work: what it reads, and the program it writes.
class ProgramMaker {
 public:
  ProgramMaker(const GcodeCommand& command, Machine& machine, HostSettings& settings,
               const EmulatorOptions& options, Instant now)
      : command_(command), machine_(machine), settings_(settings), options_(options), now_(now) {}

  CommandProgram make() {
    bool known = false;
    if (command_.letter == 'G') known = g_code();
    if (command_.letter == 'M') known = motion_code() || temperature_code() || report_code() || quiet_code();
    if (command_.letter == 'T') known = tool();
    if (!known) {
      ++machine_.record().report().unknown_commands;
      say(fmt::format("echo:Unknown command: \"{}\"\n", command_.text));
    }
    return std::move(program_);
  }

 private:
  void say(std::string text) { program_.steps.emplace_back(SayStep{std::move(text)}); }
  void add(Step step) { program_.steps.push_back(std::move(step)); }
  double value(char parameter, double otherwise) const {
    return command_.value(parameter).value_or(otherwise);
  }

  bool g_code() {
    switch (command_.code) {
      case 0:
      case 1:
        add(MoveStep{machine_.destination(command_), machine_.feedrate()});
        return true;
      case 2:
      case 3:
        if (options_.features.arcs) arc();
        return options_.features.arcs;
      case 4:
        add(FinishMovesStep{});
        add(DwellStep{from_seconds(command_.has('S') ? value('S', 0) : value('P', 0) / 1000)});
        return true;
      case 5:
        if (options_.features.bezier) bezier();
        return options_.features.bezier;
      case 20:
      case 21:
        machine_.set_inches(command_.code == 20);
        return true;
      case 28:
        home();
        return true;
      case 90:
      case 91:
        machine_.set_relative(command_.code == 91);
        return true;
      case 92:
        machine_.name_position(command_);
        add(PositionStep{});
        return true;
      default:
        return false;
    }
  }

  void arc() {
    const MachinePosition start = machine_.planned();
    const MachinePosition end = machine_.destination(command_);
    const bool clockwise = command_.code == 2;
    const double unit = machine_.unit();
    const auto length = [&](char parameter) -> std::optional<double> {
      const std::optional<double> given = command_.value(parameter);
      return given ? std::optional(*given * unit) : std::nullopt;
    };
    const std::optional<double> radius = length('R');
    const std::optional<Arc> arc =
        radius ? arc_by_radius(start, end, *radius, clockwise)
               : arc_by_center(start, length('I'), length('J'), clockwise, static_cast<int>(value('P', 0)));
    if (!arc) {
      say("Error:G2/G3 bad parameters\n");
      return;
    }
    follow(arc_segments(start, end, *arc));
  }

  void bezier() {
    const MachinePosition start = machine_.planned();
    const MachinePosition end = machine_.destination(command_);
    const double unit = machine_.unit();
    follow(bezier_segments(start, start[0] + value('I', 0) * unit, start[1] + value('J', 0) * unit,
                           end[0] + value('P', 0) * unit, end[1] + value('Q', 0) * unit, end));
  }

  void follow(const std::vector<MachinePosition>& points) {
    for (const MachinePosition& point : points) add(MoveStep{point, machine_.feedrate()});
  }

  void home() {
    std::array<bool, 3> axes{command_.has('X'), command_.has('Y'), command_.has('Z')};
    if (!axes[0] && !axes[1] && !axes[2]) axes = {true, true, true};
    add(FinishMovesStep{});
    add(DwellStep{machine_.homing_time(axes)});
    add(HomedStep{axes});
    add(PositionStep{});
  }

  bool motion_code() {
    MotionOptions& limits = machine_.planner().limits();
    const auto per_axis = [this](PerAxis& values) {
      constexpr std::array<char, 4> kAxes{'X', 'Y', 'Z', 'E'};
      for (std::size_t axis = 0; axis < 4; ++axis) {
        if (const auto given = command_.value(kAxes[axis]); given && *given > 0)
          values[axis] = *given * machine_.unit();
      }
    };
    switch (command_.code) {
      case 0:
      case 1:
        user_stop();
        return true;
      case 17:
        return true;
      case 18:
      case 84:
      case 400:
        add(FinishMovesStep{});
        return true;
      case 82:
      case 83:
        machine_.set_extruder_relative(command_.code == 83);
        return true;
      case 201:
        per_axis(limits.max_acceleration);
        return true;
      case 203:
        per_axis(limits.max_feedrate);
        return true;
      case 204:
        if (command_.has('S'))
          limits.acceleration = limits.travel_acceleration = std::max(1.0, value('S', 1));
        limits.acceleration = std::max(1.0, value('P', limits.acceleration));
        limits.retract_acceleration = std::max(1.0, value('R', limits.retract_acceleration));
        limits.travel_acceleration = std::max(1.0, value('T', limits.travel_acceleration));
        return true;
      case 205:
        if (command_.has('J'))
          limits.junction_deviation = std::max(0.001, value('J', limits.junction_deviation));
        return true;
      case 211:
        if (command_.has('S')) machine_.set_soft_limits(value('S', 1) != 0);
        say(fmt::format("Soft endstops: {}\n", value('S', 1) != 0 ? "On" : "Off"));
        return true;
      case 220:
        if (command_.has('S')) {
          machine_.set_feed_percent(std::clamp(value('S', 100), 1.0, 999.0));
        } else {
          say(fmt::format("FR:{:.0f}%\n", machine_.feed_percent()));
        }
        return true;
      case 221:
        if (command_.has('S')) {
          machine_.set_flow_percent(std::clamp(value('S', 100), 1.0, 999.0));
        } else {
          say(fmt::format("echo:E0 Flow: {:.0f}%\n", machine_.flow_percent()));
        }
        return true;
      default:
        return false;
    }
  }

  void user_stop() {
    add(FinishMovesStep{});
    if (options_.features.host_actions) {
      say(
          fmt::format("//action:prompt_end\n//action:prompt_begin M{} Stop\n//action:prompt_button Continue\n"
                      "//action:prompt_show\n",
                      command_.code));
    }
    std::optional<Duration> limit;
    if (command_.has('P')) limit = from_seconds(value('P', 0) / 1000);
    if (command_.has('S')) limit = from_seconds(value('S', 0));
    if (limit == Duration{}) limit.reset();
    add(UserStep{limit});
  }

  bool temperature_code() {
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

  void set_target(Heater& heater) const {
    if (const auto target = command_.value('S')) heater.set_target(*target);
    if (const auto target = command_.value('R')) heater.set_target(*target);
  }

  bool report_code() {
    switch (command_.code) {
      case 31:
        say(fmt::format("echo:Print time: {:.0f}s\n", to_seconds(now_.time_since_epoch())));
        return true;
      case 110:
        if (const auto number = command_.value('N')) program_.new_last_line = std::llround(*number);
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
  std::string host_message() const {
    std::string_view text = command_.string;
    std::string prefix;
    while (text.size() > 2 && (text[0] == 'E' || text[0] == 'A') && text[1] == '1' && text[2] == ' ') {
      prefix += text[0] == 'E' ? "echo:" : "//";
      text.remove_prefix(3);
    }
    return fmt::format("{}{}", prefix, text);
  }

  std::string capabilities() const {
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
        {"AUTOLEVEL", false},
        {"RUNOUT", false},
        {"Z_PROBE", false},
        {"LEVELING_DATA", false},
        {"BUILD_PERCENT", false},
        {"SOFTWARE_POWER", false},
        {"TOGGLE_LIGHTS", false},
        {"CASE_LIGHT_BRIGHTNESS", false},
        {"EMERGENCY_PARSER", features.emergency_parser},
        {"HOST_ACTION_COMMANDS", features.host_actions},
        {"PROMPT_SUPPORT", features.host_actions},
        {"SDCARD", false},
        {"REPEAT", false},
        {"SD_WRITE", false},
        {"AUTOREPORT_SD_STATUS", false},
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
        {"MEATPACK", false},
        {"CONFIG_EXPORT", false}};
    for (const auto& [name, present] : capabilities)
      text += fmt::format("Cap:{}:{}\n", name, present ? 1 : 0);
    const auto& low = options_.motion.bed_min;
    const auto& high = options_.motion.bed_max;
    const std::string box =
        fmt::format("{{min:{{x:{:.2f},y:{:.2f},z:{:.2f}}},max:{{x:{:.2f},y:{:.2f},z:{:.2f}}}}}", low[0],
                    low[1], low[2], high[0], high[1], high[2]);
    return text + fmt::format("area:{{full:{},work:{}}}\n", box, box);
  }

  /// Commands that a stock build knows and that change nothing here.
  bool quiet_code() const {
    constexpr std::array kQuiet{75, 76, 77, 92, 108, 111, 117, 200, 206, 301, 302, 304, 410, 501, 502, 503};
    return std::find(kQuiet.begin(), kQuiet.end(), command_.code) != kQuiet.end();
  }

  bool tool() {
    if (command_.code != 0) say(fmt::format("echo:T{} Invalid extruder\n", command_.code));
    return true;
  }

  const GcodeCommand& command_;
  Machine& machine_;
  HostSettings& settings_;
  const EmulatorOptions& options_;
  Instant now_;
  CommandProgram program_;
};

}  // namespace

CommandProgram make_program(const GcodeCommand& command, Machine& machine, HostSettings& settings,
                            const EmulatorOptions& options, Instant now) {
  return ProgramMaker(command, machine, settings, options, now).make();
}

}  // namespace lamina::transport
