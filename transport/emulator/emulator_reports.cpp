// What the emulated firmware does by the clock: busy lines, automatic reports, the watch over the heaters.

#include <utility>

#include <fmt/format.h>

#include "transport/emulator/emulator.h"

namespace lamina::transport {

namespace {

constexpr Duration kHeaterWatch = std::chrono::seconds(1);

}  // namespace

void Emulator::do_due(Instant now) {
  if (off_until_) {
    if (now < *off_until_) return;
    silent_until_.reset();
    restart(now);
    return;
  }
  if (deaf_until_ && now >= *deaf_until_) deaf_until_.reset();
  if (silent_until_ && now >= *silent_until_) silent_until_.reset();
  if (stalled_until_ && now >= *stalled_until_) {
    stalled_until_.reset();
    if (refusal_unfinished_) finish_refusal();
  }
  strike(faults_.at_time(now), now);
  watch_heaters(now);
  if (halted_) return;
  if (!stalled_until_) say_busy(now);

  const auto due = [now](Duration interval, std::optional<Instant>& at) {
    if (interval == Duration{} || !at || now < *at) return false;
    at = now + interval;
    return true;
  };
  if (due(settings_.temperature_interval, temperature_due_)) say(machine_.temperatures() + '\n');
  if (due(settings_.position_interval, position_due_)) say(machine_.position(now) + '\n');
  if (due(settings_.card_interval, card_due_)) say(card_progress(card_));
}

void Emulator::say_busy(Instant now) {
  if (running_ && settings_.busy_interval > Duration{} && now >= running_->busy_due) {
    const bool for_user =
        !running_->program.steps.empty() && std::holds_alternative<UserStep>(running_->program.steps.front());
    say(for_user ? "echo:busy: paused for user\n" : "echo:busy: processing\n");
    running_->busy_due = now + settings_.busy_interval;
  }
  const Duration wait = options_.serial.wait_interval;
  if (!running_ && wait > Duration{} && now >= idle_since_ + wait) {
    say("wait\n");
    idle_since_ = now;
  }
}

void Emulator::watch_heaters(Instant now) {
  if (!heaters_due_ || now < *heaters_due_) return;
  heaters_due_ = machine_.heating() ? std::optional(now + kHeaterWatch) : std::nullopt;
  const std::string hotend = hotend_protection_.look(machine_.hotend(), now);
  const std::string bed = bed_protection_.look(machine_.bed(), now);
  if (!hotend.empty()) {
    kill(now, fmt::format("Error:{}, system stopped! Heater_ID: E0\n\necho:{}\n", hotend,
                          hotend == "Heating failed" ? "Heating Failed" : hotend));
  } else if (!bed.empty()) {
    kill(now, fmt::format("Error:{}, system stopped! Heater_ID: bed\necho:{}\n", bed,
                          bed == "Heating failed" ? "Heating Failed" : bed));
  }
}

}  // namespace lamina::transport
