#include "transport/emulator/emulator.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace lamina::transport {

namespace {

void keep_earliest(std::optional<Instant>& earliest, std::optional<Instant> candidate) {
  if (candidate && (!earliest || *candidate < *earliest)) earliest = candidate;
}

/// The number of a line that begins with one.
LineNumber number_of(const std::string& line) {
  return std::strtoll(line.c_str() + 1, nullptr, 10);
}

}  // namespace

Emulator::Emulator(EmulatorOptions options, Instant now)
    : options_(std::move(options)),
      machine_(options_, now),
      hotend_protection_(options_.thermal.hotend_protection),
      bed_protection_(options_.thermal.bed_protection),
      received_(options_.serial.receive_buffer),
      assembler_(options_.serial.line_bytes),
      acceptance_(options_.features.silent_duplicates),
      now_(now),
      idle_since_(now),
      faults_(options_.faults, options_.fault_seed, now) {
  restart(now);
}

std::size_t Emulator::receive(std::string_view bytes, Instant now) {
  advance(now);
  if (deaf(now)) return bytes.size();
  std::size_t taken = 0;
  while (taken < bytes.size() && !halted_) {
    const std::size_t count = received_.push(bytes.substr(taken));
    if (options_.features.emergency_parser && !card_.writing()) {
      for (const char byte : bytes.substr(taken, count)) {
        if (const auto command = emergency_.push(byte)) act(*command, now);
      }
    }
    taken += count;
    work(now);
    if (count == 0 || options_.serial.overflow == Overflow::kLose) break;
  }
  if (deaf(now)) return bytes.size();
  if (options_.serial.overflow == Overflow::kHoldBack) return taken;
  machine_.record().report().bytes_lost += static_cast<std::int64_t>(bytes.size() - taken);
  return bytes.size();
}

void Emulator::advance(Instant now) {
  while (const std::optional<Instant> next = next_event()) {
    if (*next > now) break;
    now_ = std::max(now_, *next);
    machine_.advance(now_);
    do_due(now_);
    work(now_);
  }
  now_ = std::max(now_, now);
  machine_.advance(now_);
}

std::optional<Instant> Emulator::next_event() const {
  if (off_until_) return off_until_;
  if (halted_) return std::nullopt;
  std::optional<Instant> next = machine_.next_event();
  if (stalled_until_) {
    next = next ? std::min(*next, *stalled_until_) : *stalled_until_;
  } else if (running_) {
    keep_earliest(next, running_->waits_until);
    if (settings_.busy_interval > Duration{}) keep_earliest(next, running_->busy_due);
  } else if (options_.serial.wait_interval > Duration{}) {
    keep_earliest(next, idle_since_ + options_.serial.wait_interval);
  }
  if (settings_.temperature_interval > Duration{}) keep_earliest(next, temperature_due_);
  if (settings_.position_interval > Duration{}) keep_earliest(next, position_due_);
  if (settings_.card_interval > Duration{}) keep_earliest(next, card_due_);
  if (card_.printing() && !stalled_until_) keep_earliest(next, card_ready_);
  if (machine_.heating()) keep_earliest(next, heaters_due_);
  keep_earliest(next, deaf_until_);
  if (silent_until_ != Instant::max()) keep_earliest(next, silent_until_);
  keep_earliest(next, faults_.next());
  return next;
}

std::string Emulator::take_output() {
  return std::exchange(output_, {});
}

void Emulator::say(std::string_view text) {
  if (!silent_until_ && !unplugged_) output_ += text;
}

bool Emulator::deaf(Instant now) const {
  return halted_ || off_until_ || unplugged_ || (deaf_until_ && now < *deaf_until_);
}

bool Emulator::idle() const {
  return !running_ && queue_.empty() && received_.empty() && machine_.planner().empty() && !card_.printing();
}

void Emulator::restart(Instant now) {
  machine_.forget(now);
  card_.restart();
  received_.clear();
  meatpack_.restart();
  assembler_.clear();
  acceptance_.set_last_line(0);
  queue_.clear();
  running_.reset();
  stalled_until_.reset();
  refusal_unfinished_ = false;
  off_until_.reset();
  settings_ = {options_.serial.busy_interval,
               {},
               {},
               {},
               options_.motion.firmware_retraction,
               options_.motion.firmware_retraction_feedrate};
  halted_ = false;
  numbered_ = false;
  last_run_ = 0;
  if (options_.serial.boot_time > Duration{}) deaf_until_ = now + options_.serial.boot_time;
  say(options_.power_up_noise);
  if (!options_.greet) return;
  say("start\nPowerUp\nMarlin 2.1.2.1\necho: Last Updated: 2023-05-16 | Author: (none, default config)\n"
      "echo: Compiled: Nov  1 2026\necho: Free Memory: 0  PlannerBufferBytes: 1280\n"
      "echo:Hardcoded Default Settings Loaded\n");
}

/// The firmware's main loop: read lines as long as the queue has room, run a command, again.
void Emulator::work(Instant now) {
  while (!halted_ && !off_until_ && !stalled_until_) {
    read_lines(now);
    if (stalled_until_) return;
    if (!running_) {
      if (queue_.empty()) return;
      if (card_.writing()) {
        write_to_card(queue_.front().line);
        continue;
      }
      std::optional<LineNumber> number;
      if (queue_.front().line.starts_with('N')) number = number_of(queue_.front().line);
      strike(faults_.at_command(machine_.record().report().lines_run, number), now);
      if (queue_.empty() || stalled_until_) return;
      begin_command(now);
    }
    if (!run_steps(now)) return;
    finish_command();
    idle_since_ = now;
  }
}

void Emulator::read_lines(Instant now) {
  while (queue_.size() < options_.serial.command_queue && !received_.empty() && !halted_ && !stalled_until_) {
    for (const char character : read_characters()) {
      if (const auto line = assembler_.push(character)) take_line(*line, now);
    }
  }
  read_card(now);
}

void Emulator::read_card(Instant now) {
  while (card_.printing() && queue_.size() < options_.serial.command_queue) {
    if (card_ready_ && now < *card_ready_) return;
    const std::optional<std::string> line = card_.next_line();
    if (!line) {
      say("Done printing file\n");
      return;
    }
    if (card_line_time_ > Duration{}) card_ready_ = now + card_line_time_;
    const std::string command = line->substr(0, line->find_first_of(";\r"));
    if (command.find_first_not_of(' ') != std::string::npos) queue_.push_back({command, true});
  }
}

std::string Emulator::read_characters() {
  const char byte = received_.pop();
  if (!options_.features.meatpack) return {byte};
  MeatPackDecoder::Decoded decoded = meatpack_.push(byte);
  say(decoded.reply);
  return std::move(decoded.text);
}

void Emulator::purge() {
  while (!received_.empty()) read_characters();
  assembler_.clear();
}

void Emulator::take_line(const std::string& line, Instant now) {
  if (line.starts_with('N') && refused_to_order(number_of(line), now)) return;
  switch (acceptance_.judge(line)) {
    case Verdict::kNotNextLine:
      refuse("Line Number is not Last Line Number+1", now);
      return;
    case Verdict::kNoChecksum:
      refuse("No Checksum with line number", now);
      return;
    case Verdict::kChecksumMismatch:
      refuse("checksum mismatch", now);
      return;
    case Verdict::kDuplicate:
      ++machine_.record().report().duplicate_lines;
      return;
    case Verdict::kAccepted:
      break;
  }
  const bool closes_file = line.starts_with("M29");
  if (card_.writing() && !line.starts_with('N') && !closes_file) {
    refuse("No Checksum with line number", now);
    return;
  }
  // Without the emergency parser these act when they are read, if they have no number.
  if (!options_.features.emergency_parser) {
    if (const auto command = early_command(line)) act(*command, now);
    if (halted_) return;
  }
  queue_.push_back({line});
}

void Emulator::refuse(std::string_view error, Instant now) {
  ++machine_.record().report().refused_lines;
  say(fmt::format("Error:{}, Last Line: {}\n", error, acceptance_.last_line()));
  if (options_.serial.refusal_time > Duration{}) {
    refusal_unfinished_ = true;
    stalled_until_ = now + options_.serial.refusal_time;
  } else {
    finish_refusal();
  }
}

void Emulator::finish_refusal() {
  refusal_unfinished_ = false;
  purge();
  say(fmt::format("Resend: {}\nok\n", acceptance_.last_line() + 1));
}

void Emulator::act(EmergencyCommand command, Instant now) {
  switch (command) {
    case EmergencyCommand::kKill:
      kill(now, "echo:M112 Shutdown\n");
      return;
    case EmergencyCommand::kBreakWaits:
    case EmergencyCommand::kAnswer:
      break_waits_ = true;
      return;
    case EmergencyCommand::kQuickStop:
      machine_.stop(now);
      return;
    case EmergencyCommand::kAbortCard:
      card_.abort();
      return;
  }
}

void Emulator::kill(Instant now, std::string_view reason) {
  say(reason);
  say("Error:Printer halted. kill() called!\n");
  if (options_.features.host_actions) say("//action:poweroff\n");
  machine_.stop(now);
  machine_.hotend().set_target(0);
  machine_.bed().set_target(0);
  queue_.clear();
  running_.reset();
  halted_ = true;
}

}  // namespace lamina::transport
