#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "transport/emulator/fault_order.h"
#include "transport/time.h"

namespace lamina::transport {

/// What the firmware was compiled with. DEFAULT: stock Marlin 2.1.
struct FirmwareFeatures {
  bool advanced_ok = false;          ///< ok carries N, P and B
  bool emergency_parser = false;     ///< M112, M108, M410 act when their bytes arrive
  bool host_actions = false;         ///< //action: lines
  bool arcs = true;                  ///< G2, G3
  bool bezier = false;               ///< G5
  bool auto_report = true;           ///< M155, M154
  bool silent_duplicates = true;     ///< a line received again is dropped without a word (since 2.1.2)
  bool meatpack = false;             ///< packed lines
  bool sd_card = false;              ///< M20 to M33
  bool firmware_retraction = false;  ///< G10, G11
  bool leveling = false;             ///< G29
  bool filament_change = false;      ///< M600, G27, M125
  bool cancel_objects = false;       ///< M486
};

/// Where the bytes of a full receive buffer go.
enum class Overflow {
  kHoldBack,  ///< the host's side waits, as on native USB
  kLose       ///< they are gone, as on a real serial line
};

struct SerialOptions {
  std::size_t receive_buffer = 128;  ///< bytes; one of them stays free
  std::size_t command_queue = 4;     ///< commands, the one being run included
  std::size_t line_bytes = 95;       ///< the rest of a longer line is cut off
  Overflow overflow = Overflow::kHoldBack;
  Duration busy_interval = std::chrono::seconds(2);  ///< between busy lines; M113 changes it
  Duration wait_interval{0};                         ///< `wait` after so long with nothing to do; 0 is off
  /// From an error line to the emptying of the receive buffer: firmwares without a transmit buffer wait until
  /// the line has gone out. What arrives meanwhile is thrown away, what comes later is the tail of a line.
  Duration refusal_time{0};
  Duration boot_time{0};  ///< after power-up and restart: deaf for so long
};

/// Per axis X, Y, Z, E.
using PerAxis = std::array<double, 4>;

struct MotionOptions {
  std::array<double, 3> bed_min{0, 0, 0};        ///< mm
  std::array<double, 3> bed_max{200, 200, 200};  ///< mm
  PerAxis steps_per_mm{80, 80, 400, 500};
  PerAxis max_feedrate{300, 300, 5, 25};             ///< mm/s
  PerAxis max_acceleration{3000, 3000, 100, 10000};  ///< mm/s^2
  double acceleration = 3000;                        ///< mm/s^2, moves that extrude
  double travel_acceleration = 3000;                 ///< mm/s^2
  double retract_acceleration = 3000;                ///< mm/s^2, moves of the extruder alone
  double junction_deviation = 0.013;                 ///< mm
  /// mm/s by which an axis may change its speed at once: classic jerk instead of junction deviation.
  std::optional<PerAxis> jerk;
  double minimum_speed = 0.05;    ///< mm/s at which the planner starts and ends
  std::size_t block_buffer = 16;  ///< blocks; one of them stays free
  Duration min_segment_time =
      std::chrono::milliseconds(20);  ///< shorter ones are stretched while the buffer runs low
  Duration first_block_delay =
      std::chrono::milliseconds(100);  ///< so that a second block can come before the first starts
  std::array<double, 3> homing_feedrate{50, 50, 4};  ///< mm/s
  double min_extrude_temperature = 170;              ///< deg C
  double max_extrude_length = 200;                   ///< mm of filament in one move
  double filament_diameter = 1.75;                   ///< mm
  double firmware_retraction = 3;                    ///< mm, G10; M207 changes it
  double firmware_retraction_feedrate = 45;          ///< mm/s
  std::array<double, 3> park{0, 0, 20};              ///< mm; Z is a lift
};

/// When a heater counts as broken. DEFAULT: Marlin's for the hotend.
struct ProtectionOptions {
  double hysteresis = 4;                               ///< deg C below a target once reached ...
  Duration runaway_period = std::chrono::seconds(40);  ///< ... for so long: thermal runaway
  double heating_increase = 2;                         ///< deg C that heating up must gain ...
  Duration heating_period = std::chrono::seconds(20);  ///< ... in this time, or heating has failed
};

/// A heater as a thermal mass that loses heat to the room.
struct HeaterOptions {
  double heating_rate = 0;   ///< deg C/s at full power and room temperature
  double time_constant = 1;  ///< s in which an unheated one loses all but 1/e of its excess
  double band = 10;          ///< deg C below the target over which the power is taken back
};

struct ThermalOptions {
  double room = 20;  ///< deg C
  HeaterOptions hotend{3.5, 160, 8};
  HeaterOptions bed{0.7, 400, 4};
  Duration residency = std::chrono::seconds(10);  ///< M109 and M190 want the target held for so long
  double window = 1;                              ///< deg C from the target within which that time begins
  double hysteresis = 3;                          ///< deg C from the target beyond which it begins anew
  ProtectionOptions hotend_protection;
  ProtectionOptions bed_protection{2, std::chrono::seconds(20), 2, std::chrono::seconds(60)};
};

/// How much of the print is kept in memory.
enum class RecordDetail {
  kTotals,  ///< sums only: memory does not grow with the print
  kBeads    ///< every extruded move
};

struct EmulatorOptions {
  std::string machine_name = "Lamina Emulated Printer";
  FirmwareFeatures features;
  SerialOptions serial;
  MotionOptions motion;
  ThermalOptions thermal;
  std::vector<FaultOrder> faults;  ///< what goes wrong in the printer itself
  std::uint64_t fault_seed = 1;    ///< for those by chance
  /// What M115 says of a capability, whatever the firmware can do.
  std::map<std::string, bool> claims;
  std::string power_up_noise;  ///< said before anything else
  RecordDetail record = RecordDetail::kTotals;
  bool greet = true;  ///< say `start` and the version at power-up
};

}  // namespace lamina::transport
