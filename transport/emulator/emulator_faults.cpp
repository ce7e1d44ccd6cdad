// What goes wrong in the emulated printer to order.

#include <fmt/format.h>

#include "transport/emulator/emulator.h"

namespace lamina::transport {

bool Emulator::refused_to_order(LineNumber number, Instant now) {
  strike(faults_.at_arrival(number), now);
  if (!refusal_) return false;
  // One that is refused several times is so when it comes again.
  if (refused_ >= 0 && number != refused_) return false;
  refused_ = number;
  const FaultKind kind = refusal_->kind;
  if (--refusals_left_ <= 0) {
    refusal_.reset();
    refused_ = -1;
  }
  switch (kind) {
    case FaultKind::kRefuseNumber:
      refuse("Line Number is not Last Line Number+1", now);
      break;
    case FaultKind::kRefuseMissing:
      refuse("No Checksum with line number", now);
      break;
    case FaultKind::kRefuseSilently:
      say(fmt::format("Error:No Line Number with checksum, Last Line: {}\n", acceptance_.last_line()));
      break;
    default:
      refuse("checksum mismatch", now);
      break;
  }
  return true;
}

void Emulator::strike(const std::vector<FaultOrder>& orders, Instant now) {
  for (const FaultOrder& order : orders) strike(order, now);
}

void Emulator::strike(const FaultOrder& order, Instant now) {
  const Instant until = now + from_seconds(order.amount);
  switch (order.kind) {
    case FaultKind::kLoseOk:
    case FaultKind::kRepeatOk:
    case FaultKind::kMangleOk:
      ok_fault_ = order;
      break;
    case FaultKind::kRefuseNumber:
    case FaultKind::kRefuseChecksum:
    case FaultKind::kRefuseMissing:
    case FaultKind::kRefuseSilently:
      refusal_ = order;
      refusals_left_ = static_cast<int>(order.amount);
      refused_ = -1;
      break;
    case FaultKind::kResendStorm:
      for (int i = 0; i < static_cast<int>(order.amount); ++i)
        say(fmt::format("Resend: {}\nok\n", acceptance_.last_line() + 1));
      break;
    case FaultKind::kStall:
      stalled_until_ = until;
      break;
    case FaultKind::kSilence:
      silent_until_ = order.amount > 0 ? until : Instant::max();
      break;
    case FaultKind::kFullBuffer:
      deaf_until_ = until;
      break;
    case FaultKind::kSay:
      say(order.text + '\n');
      break;
    case FaultKind::kRestart:
      if (order.amount <= 0) {
        restart(now);
        break;
      }
      machine_.forget(now);
      queue_.clear();
      running_.reset();
      off_until_ = until;
      break;
    case FaultKind::kHeaterFails:
      machine_.hotend().break_wire();
      break;
    case FaultKind::kThermalRunaway:
      kill(now, "Error:Thermal Runaway, system stopped! Heater_ID: E0\n\necho:Thermal Runaway\n");
      break;
    case FaultKind::kSlowCard:
      card_line_time_ = from_seconds(order.amount);
      break;
    case FaultKind::kUnplug:
      unplugged_ = true;
      break;
    default:
      break;  // of single bytes: the wires'
  }
}

}  // namespace lamina::transport
