#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "transport/emulator/command_program.h"
#include "transport/emulator/emergency_parser.h"
#include "transport/emulator/emulator_options.h"
#include "transport/emulator/fault_schedule.h"
#include "transport/emulator/machine.h"
#include "transport/emulator/print_record.h"
#include "transport/emulator/receive_buffer.h"
#include "transport/emulator/sd_card.h"
#include "transport/emulator/thermal_protection.h"
#include "transport/protocol/line_acceptance.h"
#include "transport/protocol/line_assembler.h"
#include "transport/protocol/meatpack_decoder.h"
#include "transport/time.h"

namespace lamina::transport {

/// A line in the command queue.
struct QueuedCommand {
  std::string line;
  bool from_card = false;  ///< not acknowledged
};

/// The command at work, and what its present step waits for.
struct RunningCommand {
  CommandProgram program;
  Instant busy_due{};                      ///< the next busy line
  std::optional<Instant> waits_until;      ///< of the step at hand
  std::optional<Instant> in_window_since;  ///< a HeatStep: its target is being held
  std::optional<Instant> report_due;       ///< a HeatStep: its next temperature line
};

/// A printer with Marlin 2.1, without I/O, clock or thread: bytes and the time go in, bytes come out.
///
/// Bytes take Marlin's way: receive buffer -> (emergency parser) -> (unpacker) -> line -> numbering and
/// checksum -> command queue -> execution -> planner. Errors are told when a line is read, ok when it has
/// been run; an error throws away what is in the receive buffer. The bytes of every reply are Marlin's.
class Emulator {
 public:
  /// Powers up at `now`.
  explicit Emulator(EmulatorOptions options = {}, Instant now = {});

  /// Takes bytes from the host at `now`. Returns how many: all of them with Overflow::kLose; with kHoldBack
  /// what there is room for, the rest is to be offered again when time has gone on.
  std::size_t receive(std::string_view bytes, Instant now);

  /// Lives on until `now`.
  void advance(Instant now);

  /// When something happens next without any bytes coming in. None: never.
  std::optional<Instant> next_event() const;

  /// Bytes for the host; empty when there are none.
  std::string take_output();

  /// Power off and on, or the reset button: numbering, queue, targets and position are lost, record and card
  /// are not.
  void restart(Instant now);

  /// Halted by M112 or a fault; deaf until restarted.
  bool halted() const { return halted_; }

  /// Its cable has been pulled, to order: not a byte in or out any more.
  bool unplugged() const { return unplugged_; }

  /// Nothing queued, nothing running, nothing moving.
  bool idle() const;

  const PrintReport& report() const { return machine_.record().report(); }
  const std::vector<Bead>& beads() const { return machine_.record().beads(); }
  const Machine& machine() const { return machine_; }
  SdCard& card() { return card_; }
  LineNumber last_line() const { return acceptance_.last_line(); }

 private:
  void say(std::string_view text);
  void work(Instant now);
  void read_lines(Instant now);
  /// The characters that are next in the receive buffer, unpacked: none, one or two.
  std::string read_characters();
  /// Throws away what has been received, as the firmware does behind an error.
  void purge();
  void take_line(const std::string& line, Instant now);
  void refuse(std::string_view error, Instant now);
  void finish_refusal();
  void read_card(Instant now);
  void act(EmergencyCommand command, Instant now);
  void kill(Instant now, std::string_view reason);
  bool deaf(Instant now) const;

  // emulator_commands.cpp: the command at work
  void begin_command(Instant now);
  void count_line(const std::string& line);
  void write_to_card(const std::string& line);
  /// Runs the steps at hand. True when the command is done.
  bool run_steps(Instant now);
  bool run(const Step& step, Instant now);
  bool start_move(const Machine::Prepared& prepared, Instant now);
  bool run_heat(const HeatStep& step, Instant now);
  void finish_command();
  void say_ok(const std::string& ok);
  Heater& heater(HeaterName name) { return name == HeaterName::kHotend ? machine_.hotend() : machine_.bed(); }

  // emulator_reports.cpp: what is said by the clock
  void do_due(Instant now);
  void say_busy(Instant now);
  void watch_heaters(Instant now);

  // emulator_faults.cpp: what goes wrong to order
  /// True if the line is not to be looked at any more.
  bool refused_to_order(LineNumber number, Instant now);
  void strike(const std::vector<FaultOrder>& orders, Instant now);
  void strike(const FaultOrder& order, Instant now);

  EmulatorOptions options_;
  Machine machine_;
  SdCard card_;
  ThermalProtection hotend_protection_;
  ThermalProtection bed_protection_;
  ReceiveBuffer received_;
  MeatPackDecoder meatpack_;
  LineAssembler assembler_;
  LineAcceptance acceptance_;
  EmergencyParser emergency_;
  std::deque<QueuedCommand> queue_;  ///< accepted lines; the front one is being run
  std::optional<RunningCommand> running_;
  HostSettings settings_;
  std::string output_;
  Instant now_;
  std::optional<Instant> temperature_due_;
  std::optional<Instant> position_due_;
  std::optional<Instant> card_due_;
  std::optional<Instant> heaters_due_;
  Instant idle_since_;
  bool break_waits_ = false;
  bool halted_ = false;
  LineNumber last_run_ = 0;  ///< the number of the last numbered line that was run
  bool numbered_ = false;    ///< the host numbers its lines

  FaultSchedule faults_;
  std::optional<Instant> stalled_until_;  ///< nothing is read or run
  bool refusal_unfinished_ = false;    ///< an error line has gone out, the rest comes when the stall is over
  std::optional<Instant> deaf_until_;  ///< bytes from the host are lost
  std::optional<Instant> silent_until_;  ///< nothing is said; Instant::max(): for good
  std::optional<Instant> off_until_;
  bool unplugged_ = false;
  std::optional<FaultOrder> refusal_;  ///< for the next lines that arrive
  int refusals_left_ = 0;
  LineNumber refused_ = -1;             ///< the line that is refused again and again
  std::optional<FaultOrder> ok_fault_;  ///< for the next ok
  Duration card_line_time_{};
  std::optional<Instant> card_ready_;
};

}  // namespace lamina::transport
