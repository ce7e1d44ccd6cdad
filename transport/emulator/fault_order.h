#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "transport/emulator/wire.h"

namespace lamina::transport {

/// What can go wrong to order.
enum class FaultKind {
  // One byte, on its way to the printer or, `Reply`, to the host.
  kFlip,
  kDrop,
  kRepeat,
  kInsert,
  kFlipReply,
  kDropReply,
  kRepeatReply,
  kInsertReply,
  // The next ok.
  kLoseOk,
  kRepeatOk,
  kMangleOk,  ///< `text` instead of it
  // The next line that arrives, whatever it is.
  kRefuseNumber,    ///< "Line Number is not Last Line Number+1"; `amount` times
  kRefuseChecksum,  ///< "checksum mismatch"; `amount` times
  kRefuseMissing,   ///< "No Checksum with line number"; `amount` times
  kRefuseSilently,  ///< "No Line Number with checksum", and no request for a resend
  // The printer as a whole.
  kResendStorm,     ///< asks for the next line `amount` times, for no reason
  kStall,           ///< reads and runs nothing for `amount` seconds; what moves goes on moving
  kSilence,         ///< says nothing for `amount` seconds, for good with 0
  kFullBuffer,      ///< loses every byte that arrives in `amount` seconds
  kSay,             ///< says the line `text`
  kRestart,         ///< is off for `amount` seconds, then starts anew
  kHeaterFails,     ///< the hotend's heater heats no more: the thermal protection will notice
  kThermalRunaway,  ///< halts with that fault at once
  kSlowCard,        ///< `amount` seconds between two lines of a print from the SD card
  kUnplug           ///< no byte gets through any more
};

/// What a fault waits for.
enum class FaultClock {
  kLine,     ///< the line of that number
  kCommand,  ///< so many commands run
  kByte,     ///< so many bytes on the wire (of byte faults)
  kTime,     ///< so many seconds since power-up
  kChance    ///< with each byte or command, by that chance
};

struct FaultOrder {
  FaultKind kind = FaultKind::kLoseOk;
  FaultClock clock = FaultClock::kCommand;
  double at = 0;
  double amount = 1;
  std::string text;
};

/// A fault that cannot be understood.
class FaultOrderError : public std::runtime_error {
 public:
  FaultOrderError(std::string order, const std::string& problem);

  std::string order;
};

/// "lose-ok@line:50", "stall=5@time:30", "flip@chance:0.001", "say=//action:pause@command:20": what, how much
/// or which text, and when. Throws FaultOrderError.
FaultOrder parse_fault_order(std::string_view order);

/// The inverse.
std::string text_of(const FaultOrder& order);

/// Every kind with what it does, one a line, for a help text.
std::string fault_order_help();

/// Hands the orders for single bytes over to the wires; `orders` keeps the rest, which is the emulator's.
void give_to_wires(std::vector<FaultOrder>& orders, WireFaults& to_printer, WireFaults& to_host);

}  // namespace lamina::transport
