// The command that the emulated firmware is at, from its start to its ok; emulator.cpp has the way of a line
// up to here.

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "transport/emulator/emulator.h"
#include "transport/protocol/command_class.h"

namespace lamina::transport {

namespace {

/// How often a wait for a heater looks at the temperature.
constexpr Duration kHeatCheck = std::chrono::milliseconds(100);

/// Between two temperature lines of M109 and M190.
constexpr Duration kHeatReport = std::chrono::seconds(1);

/// "N12" of "N12 G1 X5" and of "N12G1X5".
std::string number_word(const std::string& line) {
  return line.substr(0, line.find_first_not_of("-0123456789", 1));
}

}  // namespace

void Emulator::begin_command(Instant now) {
  const std::string& line = queue_.front().line;
  PrintReport& report = machine_.record().report();
  ++report.lines_run;
  running_.emplace();
  running_->busy_due = now + settings_.busy_interval;
  // A break that came while nothing waited is spent.
  break_waits_ = false;
  const HostSettings before = settings_;
  const GcodeCommand command = parse_gcode_command(line);
  const std::int64_t unknown = report.unknown_commands;
  running_->program = make_program(command, {machine_, settings_, card_, options_, now});
  const bool known = report.unknown_commands == unknown;
  if (settings_.temperature_interval != before.temperature_interval)
    temperature_due_ = now + settings_.temperature_interval;
  if (settings_.position_interval != before.position_interval)
    position_due_ = now + settings_.position_interval;
  if (settings_.card_interval != before.card_interval) card_due_ = now + settings_.card_interval;
  if (machine_.heating() && !heaters_due_) heaters_due_ = now;

  if (running_->program.new_last_line) {
    acceptance_.set_last_line(*running_->program.new_last_line);
    last_run_ = *running_->program.new_last_line;
    numbered_ = true;
  } else if (!queue_.front().from_card) {
    // (A line that sets the number is none in the sequence.)
    if (line.starts_with('N') && line.find("M110") == std::string::npos) count_line(line);
    const bool tail = numbered_ && known && !line.starts_with('N');
    report.unnumbered_commands += tail ? 1 : 0;
    report.unnumbered_moves += tail && classify(command.text) == CommandClass::kMotion ? 1 : 0;
  }
  if (running_->program.request_resend) {
    purge();
    say(fmt::format("Resend: {}\nok\n", acceptance_.last_line() + 1));
  }
}

void Emulator::count_line(const std::string& line) {
  PrintReport& report = machine_.record().report();
  const LineNumber number = std::strtoll(line.c_str() + 1, nullptr, 10);
  if (number <= last_run_) ++report.doubled_lines;
  if (number > last_run_ + 1) report.skipped_lines += number - last_run_ - 1;
  last_run_ = number;
}

void Emulator::write_to_card(const std::string& line) {
  const GcodeCommand command = parse_gcode_command(line);
  if (command.letter == 'M' && command.code == 29) {
    card_.close_file();
    say("Done saving file.\n");
  } else {
    card_.write_line(command.text);
  }
  if (line.starts_with('N')) count_line(line);
  say_ok("ok\n");
  queue_.pop_front();
}

bool Emulator::run_steps(Instant now) {
  while (!running_->program.steps.empty()) {
    const Step step = running_->program.steps.front();
    if (!run(step, now)) return false;
    if (halted_) return true;
    running_->program.steps.pop_front();
    running_->waits_until.reset();
  }
  return true;
}

bool Emulator::run(const Step& step, Instant now) {
  if (const auto* move = std::get_if<MoveStep>(&step)) {
    if (machine_.planner().free() == 0) return false;
    return start_move(machine_.prepare_move(move->target, move->feedrate), now);
  }
  if (const auto* retraction = std::get_if<RetractStep>(&step)) {
    if (machine_.planner().free() == 0) return false;
    return start_move(machine_.prepare_retraction(retraction->length, retraction->feedrate), now);
  }
  if (std::holds_alternative<FinishMovesStep>(step)) {
    machine_.expect_standstill();
    return machine_.planner().empty();
  }
  if (const auto* dwell = std::get_if<DwellStep>(&step)) {
    if (!running_->waits_until) running_->waits_until = now + dwell->time;
    return now >= *running_->waits_until;
  }
  if (const auto* homed = std::get_if<HomedStep>(&step)) {
    machine_.finish_homing(homed->axes);
    return true;
  }
  if (const auto* heat = std::get_if<HeatStep>(&step)) return run_heat(*heat, now);
  if (const auto* user = std::get_if<UserStep>(&step)) {
    if (!running_->waits_until && user->limit) running_->waits_until = now + *user->limit;
    const bool over = running_->waits_until && now >= *running_->waits_until;
    return std::exchange(break_waits_, false) || over;
  }
  if (const auto* words = std::get_if<SayStep>(&step)) say(words->text);
  if (std::holds_alternative<PositionStep>(step)) say(machine_.position(now) + '\n');
  if (std::holds_alternative<KillStep>(step)) kill(now, "echo:M112 Shutdown\n");
  return true;
}

bool Emulator::start_move(const Machine::Prepared& prepared, Instant now) {
  say(prepared.message);
  if (prepared.move) machine_.start_move(*prepared.move, now);
  return true;
}

bool Emulator::run_heat(const HeatStep& step, Instant now) {
  const ThermalOptions& thermal = options_.thermal;
  const Heater& waited_for = heater(step.heater);
  machine_.expect_standstill();
  if (std::exchange(break_waits_, false)) return true;
  const double missing = waited_for.target() - waited_for.temperature();
  const bool first_look = !running_->waits_until;
  if (first_look) running_->report_due = now;
  // M109 S does not wait for cooling, M109 R does.
  if (first_look && missing < 0 && !step.also_cool) return true;

  std::optional<Instant>& since = running_->in_window_since;
  if (!since && std::abs(missing) <= thermal.window) since = now;
  if (since && std::abs(missing) > thermal.hysteresis) since.reset();
  if (since && now >= *since + thermal.residency) {
    since.reset();
    return true;
  }
  if (now >= *running_->report_due) {
    *running_->report_due += kHeatReport;
    const std::string left =
        since ? fmt::format("{}", (*since + thermal.residency - now) / std::chrono::seconds(1)) : "?";
    say(fmt::format("{} W:{}\n", machine_.temperatures(), left));
  }
  running_->waits_until = now + kHeatCheck;
  return false;
}

void Emulator::finish_command() {
  if (halted_) return;
  const QueuedCommand& command = queue_.front();
  if (running_->program.acknowledged && !command.from_card) {
    if (options_.features.advanced_ok) {
      // B still counts the command that is being acknowledged as queued.
      say_ok(fmt::format("ok{}{} P{} B{}\n", command.line.starts_with('N') ? " " : "",
                         command.line.starts_with('N') ? number_word(command.line) : "",
                         machine_.planner().free(), options_.serial.command_queue - queue_.size()));
    } else {
      say_ok("ok\n");
    }
  }
  running_.reset();
  queue_.pop_front();
}

void Emulator::say_ok(const std::string& ok) {
  const std::optional<FaultOrder> fault = std::exchange(ok_fault_, std::nullopt);
  if (!fault) {
    say(ok);
    return;
  }
  if (fault->kind == FaultKind::kMangleOk) say(fault->text + '\n');
  if (fault->kind == FaultKind::kRepeatOk) say(ok + ok);
}

}  // namespace lamina::transport
