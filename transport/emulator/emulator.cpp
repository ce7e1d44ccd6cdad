#include "transport/emulator/emulator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace lamina::transport {

namespace {

/// How often a wait for a heater looks at the temperature.
constexpr Duration kHeatCheck = std::chrono::milliseconds(100);
constexpr std::string_view kM112 = "echo:M112 Shutdown\n";

/// Between two temperature lines of M109 and M190.
constexpr Duration kHeatReport = std::chrono::seconds(1);

void keep_earliest(std::optional<Instant>& earliest, std::optional<Instant> candidate) {
  if (candidate && (!earliest || *candidate < *earliest)) earliest = candidate;
}

}  // namespace

Emulator::Emulator(EmulatorOptions options, Instant now)
    : options_(std::move(options)),
      machine_(options_, now),
      received_(options_.serial.receive_buffer),
      assembler_(options_.serial.line_bytes),
      acceptance_(options_.features.silent_duplicates),
      now_(now),
      idle_since_(now) {
  restart(now);
}

std::size_t Emulator::receive(std::string_view bytes, Instant now) {
  advance(now);
  if (halted_) return bytes.size();
  std::size_t taken = 0;
  while (taken < bytes.size() && !halted_) {
    const std::size_t count = received_.push(bytes.substr(taken));
    if (options_.features.emergency_parser) {
      for (const char byte : bytes.substr(taken, count)) {
        if (const auto command = emergency_.push(byte)) act(*command, now);
      }
    }
    taken += count;
    work(now);
    if (count == 0 || options_.serial.overflow == Overflow::kLose) break;
  }
  if (options_.serial.overflow == Overflow::kHoldBack) return taken;
  machine_.record().report().bytes_lost += static_cast<std::int64_t>(bytes.size() - taken);
  return bytes.size();
}

void Emulator::advance(Instant now) {
  while (const std::optional<Instant> next = next_event()) {
    if (*next > now) break;
    now_ = std::max(now_, *next);
    machine_.advance(now_);
    say_due_reports(now_);
    work(now_);
  }
  now_ = std::max(now_, now);
  machine_.advance(now_);
}

std::optional<Instant> Emulator::next_event() const {
  if (halted_) return std::nullopt;
  std::optional<Instant> next = machine_.next_event();
  if (running_) {
    keep_earliest(next, running_->waits_until);
    if (settings_.busy_interval > Duration{}) keep_earliest(next, running_->busy_due);
  } else if (options_.serial.wait_interval > Duration{}) {
    keep_earliest(next, idle_since_ + options_.serial.wait_interval);
  }
  if (settings_.temperature_interval > Duration{}) keep_earliest(next, temperature_due_);
  if (settings_.position_interval > Duration{}) keep_earliest(next, position_due_);
  return next;
}

std::string Emulator::take_output() {
  return std::exchange(output_, {});
}

bool Emulator::idle() const {
  return !running_ && queue_.empty() && received_.empty() && machine_.planner().empty();
}

void Emulator::restart(Instant now) {
  machine_.forget(now);
  received_.clear();
  assembler_.clear();
  acceptance_.set_last_line(0);
  queue_.clear();
  running_.reset();
  settings_ = {options_.serial.busy_interval, {}, {}};
  halted_ = false;
  if (!options_.greet) return;
  output_ +=
      "start\nPowerUp\nMarlin 2.1.2.1\necho: Last Updated: 2023-05-16 | Author: (none, default config)\n"
      "echo: Compiled: Nov  1 2026\necho: Free Memory: 0  PlannerBufferBytes: 1280\n"
      "echo:Hardcoded Default Settings Loaded\n";
}

/// The firmware's main loop: read lines as long as the queue has room, run a command, again.
void Emulator::work(Instant now) {
  while (!halted_) {
    read_lines(now);
    if (!running_) {
      if (queue_.empty() || fail_to_order(now)) return;
      begin_command(now);
    }
    if (!run_steps(now)) return;
    finish_command();
    idle_since_ = now;
  }
}

void Emulator::read_lines(Instant now) {
  while (queue_.size() < options_.serial.command_queue && !received_.empty() && !halted_) {
    if (const auto line = assembler_.push(received_.pop())) take_line(*line, now);
  }
}

void Emulator::take_line(const std::string& line, Instant now) {
  switch (acceptance_.judge(line)) {
    case Verdict::kNotNextLine:
      refuse("Line Number is not Last Line Number+1");
      return;
    case Verdict::kNoChecksum:
      refuse("No Checksum with line number");
      return;
    case Verdict::kChecksumMismatch:
      refuse("checksum mismatch");
      return;
    case Verdict::kDuplicate:
      ++machine_.record().report().duplicate_lines;
      return;
    case Verdict::kAccepted:
      break;
  }
  // Without the emergency parser these act when they are read, if they have no number.
  if (!options_.features.emergency_parser) {
    if (const auto command = emergency_command(line)) act(*command, now);
    if (halted_) return;
  }
  queue_.push_back(line);
}

void Emulator::refuse(std::string_view error) {
  ++machine_.record().report().refused_lines;
  received_.clear();
  assembler_.clear();
  output_ += fmt::format("Error:{}, Last Line: {}\nResend: {}\nok\n", error, acceptance_.last_line(),
                         acceptance_.last_line() + 1);
}

void Emulator::act(EmergencyCommand command, Instant now) {
  switch (command) {
    case EmergencyCommand::kKill:
      kill(now, kM112);
      return;
    case EmergencyCommand::kBreakWaits:
      break_waits_ = true;
      return;
    case EmergencyCommand::kQuickStop:
      machine_.stop(now);
      return;
  }
}

void Emulator::begin_command(Instant now) {
  ++machine_.record().report().lines_run;
  running_.emplace();
  running_->busy_due = now + settings_.busy_interval;
  // A break that came while nothing waited is spent.
  break_waits_ = false;
  const Duration reported_every = settings_.temperature_interval;
  const Duration located_every = settings_.position_interval;
  running_->program = make_program(parse_gcode_command(queue_.front()), machine_, settings_, options_, now);
  if (settings_.temperature_interval != reported_every)
    temperature_due_ = now + settings_.temperature_interval;
  if (settings_.position_interval != located_every) position_due_ = now + settings_.position_interval;
  if (running_->program.new_last_line) acceptance_.set_last_line(*running_->program.new_last_line);
  if (running_->program.request_resend) {
    received_.clear();
    assembler_.clear();
    output_ += fmt::format("Resend: {}\nok\n", acceptance_.last_line() + 1);
  }
}

bool Emulator::run_steps(Instant now) {
  std::deque<Step>& steps = running_->program.steps;
  while (!steps.empty()) {
    const Step step = steps.front();
    if (!run(step, now)) return false;
    if (halted_) return true;
    steps.pop_front();
    running_->waits_until.reset();
  }
  return true;
}

bool Emulator::run(const Step& step, Instant now) {
  if (const auto* move = std::get_if<MoveStep>(&step)) {
    if (machine_.planner().free() == 0) return false;
    const Machine::Prepared prepared = machine_.prepare_move(move->target, move->feedrate);
    output_ += prepared.message;
    if (prepared.move) machine_.start_move(*prepared.move, now);
    return true;
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
  if (const auto* words = std::get_if<SayStep>(&step)) output_ += words->text;
  if (std::holds_alternative<PositionStep>(step)) output_ += machine_.position(now) + '\n';
  if (std::holds_alternative<KillStep>(step)) kill(now, kM112);
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
    output_ += fmt::format("{} W:{}\n", machine_.temperatures(), left);
  }
  running_->waits_until = now + kHeatCheck;
  return false;
}

void Emulator::finish_command() {
  if (halted_) return;
  if (running_->program.acknowledged) {
    if (options_.features.advanced_ok) {
      std::string number;
      if (queue_.front().starts_with('N')) {
        number =
            fmt::format(" {}", queue_.front().substr(0, queue_.front().find_first_not_of("-0123456789", 1)));
      }
      // B still counts the command that is being acknowledged as queued.
      output_ += fmt::format("ok{} P{} B{}\n", number, machine_.planner().free(),
                             options_.serial.command_queue - queue_.size());
    } else {
      output_ += "ok\n";
    }
  }
  running_.reset();
  queue_.pop_front();
}

void Emulator::say_due_reports(Instant now) {
  if (running_ && settings_.busy_interval > Duration{} && now >= running_->busy_due) {
    const bool for_user =
        !running_->program.steps.empty() && std::holds_alternative<UserStep>(running_->program.steps.front());
    output_ += for_user ? "echo:busy: paused for user\n" : "echo:busy: processing\n";
    running_->busy_due = now + settings_.busy_interval;
  }
  const Duration wait = options_.serial.wait_interval;
  if (!running_ && wait > Duration{} && now >= idle_since_ + wait) {
    output_ += "wait\n";
    idle_since_ = now;
  }
  if (settings_.temperature_interval > Duration{} && temperature_due_ && now >= *temperature_due_) {
    output_ += machine_.temperatures() + '\n';
    temperature_due_ = now + settings_.temperature_interval;
  }
  if (settings_.position_interval > Duration{} && position_due_ && now >= *position_due_) {
    output_ += machine_.position(now) + '\n';
    position_due_ = now + settings_.position_interval;
  }
}

bool Emulator::fail_to_order(Instant now) {
  const std::int64_t lines_run = machine_.record().report().lines_run;
  if (lines_run == options_.faults.halt_at) {
    kill(now, "Error:Thermal Runaway, system stopped! Heater_ID: E0\n\necho:Thermal Runaway\n");
    return true;
  }
  if (lines_run != options_.faults.restart_at) return false;
  options_.faults.restart_at = -1;
  restart(now);
  return true;
}

void Emulator::kill(Instant now, std::string_view reason) {
  output_ += reason;
  output_ += "Error:Printer halted. kill() called!\n";
  if (options_.features.host_actions) output_ += "//action:poweroff\n";
  machine_.stop(now);
  machine_.hotend().set_target(0);
  machine_.bed().set_target(0);
  queue_.clear();
  running_.reset();
  halted_ = true;
}

}  // namespace lamina::transport
