#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>

#include "transport/emulator/emulator_options.h"
#include "transport/emulator/gcode_command.h"
#include "transport/emulator/heater.h"
#include "transport/emulator/planner.h"
#include "transport/emulator/print_record.h"

namespace lamina::transport {

/// The printer without its serial line: where it is, how words on a line are meant, what is hot.
class Machine {
 public:
  Machine(const EmulatorOptions& options, Instant now);

  // --- how coordinates are meant
  void set_relative(bool relative) {
    modes_.relative = relative;
    modes_.extruder_relative = relative;
  }
  void set_extruder_relative(bool relative) { modes_.extruder_relative = relative; }
  void set_inches(bool inches) { modes_.unit = inches ? 25.4 : 1.0; }
  void set_feed_percent(double percent) { modes_.feed_percent = percent; }
  void set_flow_percent(double percent) { modes_.flow_percent = percent; }
  void set_soft_limits(bool on) { modes_.soft_limits = on; }
  double feed_percent() const { return modes_.feed_percent; }
  double flow_percent() const { return modes_.flow_percent; }
  double unit() const { return modes_.unit; }

  /// G92: calls the present place by the coordinates given.
  void name_position(const GcodeCommand& command);

  /// The place that the X, Y, Z and E words of a move lead to, and its F taken over.
  MachinePosition destination(const GcodeCommand& command);

  /// mm/s of a move now.
  double feedrate() const { return modes_.feedrate * modes_.feed_percent / 100; }

  /// Where the next move starts: machine coordinates, as planned.
  const MachinePosition& planned() const { return planned_; }

  /// A straight move from `planned` to `target`, through soft limits and the guards of the extruder. None if
  /// there is nothing to do. `message` is what the firmware says about it, a line or nothing.
  struct Prepared {
    std::optional<PlannedMove> move;
    std::string message;
  };
  Prepared prepare_move(MachinePosition target, double feedrate);

  /// Takes a prepared move over into the planner, which must have a free place.
  void start_move(const PlannedMove& move, Instant now);

  /// G10 and G11: the extruder alone, by `length` mm, without a change of its coordinate.
  Prepared prepare_retraction(double length, double feedrate);

  /// G10 has drawn the filament back.
  bool retracted() const { return modes_.firmware_retracted; }
  void set_retracted(bool retracted) { modes_.firmware_retracted = retracted; }

  /// M486: moves come to nothing while the present object is cancelled.
  struct Objects {
    int current = -1;
    std::set<int> cancelled;
    bool skipping() const { return cancelled.contains(current); }
  };
  Objects& objects() { return objects_; }

  /// G28: the time it takes from where the axes are; and its end.
  Duration homing_time(const std::array<bool, 3>& axes) const;
  void finish_homing(const std::array<bool, 3>& axes);

  /// The planner is to run dry from here on: no underrun if it does.
  void expect_standstill() { standstill_expected_ = true; }

  /// As after power-up: absolute millimetres, not homed, resting where position zero is thought to be,
  /// everything off.
  void forget(Instant now);

  /// M410, and a stop for good: drops the moves; the present place is where it stopped.
  void stop(Instant now);

  /// Follows heaters and planner to `now`.
  void advance(Instant now);
  /// When a move starts or ends next.
  std::optional<Instant> next_event() const { return planner_.next_event(); }

  Planner& planner() { return planner_; }
  const Planner& planner() const { return planner_; }
  Heater& hotend() { return hotend_; }
  Heater& bed() { return bed_; }
  bool heating() const { return hotend_.target() > 0 || bed_.target() > 0; }
  PrintRecord& record() { return record_; }
  const PrintRecord& record() const { return record_; }

  /// " T:20.62 /0.00 B:20.62 /0.00 @:0 B@:0"
  std::string temperatures() const;
  /// "X:50.00 Y:50.00 Z:5.00 E:0.00 Count X:4000 Y:4000 Z:2000"
  std::string position(Instant now) const;

 private:
  /// How the words of a line are meant.
  struct Modes {
    std::array<double, 4> shift{};  ///< named coordinate - machine coordinate, mm
    std::array<bool, 3> homed{};
    bool relative = false;
    bool extruder_relative = false;
    bool soft_limits = true;
    bool firmware_retracted = false;
    double unit = 1;       ///< mm
    double feedrate = 25;  ///< mm/s
    double feed_percent = 100;
    double flow_percent = 100;
  };

  /// The move as it really goes.
  PlannedMove displaced(PlannedMove move) const;

  /// The way there, as the record and the planner take it.
  Prepared prepare(const MachinePosition& target, double extrusion, double feedrate);

  MotionOptions motion_;
  Planner planner_;
  Heater hotend_;
  Heater bed_;
  PrintRecord record_;

  MachinePosition planned_{};
  /// Where the nozzle really is, less where the firmware believes it to be: the axes stay where they are when
  /// it restarts and begins to count at zero. Homing an axis puts that right.
  std::array<double, 3> displacement_{};
  Modes modes_;

  std::optional<Instant> first_move_;
  Objects objects_;
  std::optional<Instant> ran_dry_;  ///< while extruding
  bool pressure_ = false;           ///< the last thing the extruder did was to push
  std::optional<Instant> oozes_since_;
  bool standstill_expected_ = false;
};

}  // namespace lamina::transport
