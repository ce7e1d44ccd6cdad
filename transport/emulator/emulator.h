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
#include "transport/emulator/line_acceptance.h"
#include "transport/emulator/line_assembler.h"
#include "transport/emulator/machine.h"
#include "transport/emulator/print_record.h"
#include "transport/emulator/receive_buffer.h"
#include "transport/time.h"

namespace lamina::transport {

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
/// Bytes take Marlin's way: receive buffer -> (emergency parser) -> line -> numbering and checksum -> command
/// queue -> execution -> planner. Errors are told when a line is read, ok when it has been run; an error
/// throws away what is in the receive buffer. The bytes of every reply are Marlin's.
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

  /// Power off and on, or the reset button: numbering, queue, targets and position are lost, the record is
  /// not.
  void restart(Instant now);

  /// Halted by M112; deaf until restarted.
  bool halted() const { return halted_; }

  /// Nothing queued, nothing running, nothing moving.
  bool idle() const;

  const PrintReport& report() const { return machine_.record().report(); }
  const std::vector<Bead>& beads() const { return machine_.record().beads(); }
  const Machine& machine() const { return machine_; }
  LineNumber last_line() const { return acceptance_.last_line(); }

 private:
  void work(Instant now);
  void read_lines(Instant now);
  void take_line(const std::string& line, Instant now);
  void refuse(std::string_view error);
  void act(EmergencyCommand command, Instant now);
  void begin_command(Instant now);
  /// Runs the steps at hand. True when the command is done.
  bool run_steps(Instant now);
  bool run(const Step& step, Instant now);
  bool run_heat(const HeatStep& step, Instant now);
  void finish_command();
  void say_due_reports(Instant now);
  /// True if a fault to order struck instead of the command.
  bool fail_to_order(Instant now);
  void kill(Instant now, std::string_view reason);
  Heater& heater(HeaterName name) { return name == HeaterName::kHotend ? machine_.hotend() : machine_.bed(); }

  EmulatorOptions options_;
  Machine machine_;
  ReceiveBuffer received_;
  LineAssembler assembler_;
  LineAcceptance acceptance_;
  EmergencyParser emergency_;
  std::deque<std::string> queue_;  ///< accepted lines; the front one is being run
  std::optional<RunningCommand> running_;
  HostSettings settings_;
  std::string output_;
  Instant now_;
  std::optional<Instant> temperature_due_;
  std::optional<Instant> position_due_;
  Instant idle_since_;
  bool break_waits_ = false;
  bool halted_ = false;
};

}  // namespace lamina::transport
