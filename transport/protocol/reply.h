#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "transport/protocol/line_framing.h"

namespace lamina::transport {

/// One heater or sensor in a temperature report.
struct HeaterReading {
  std::string heater;        ///< as the firmware calls it: "T", "T0", "B", "C"
  double current = 0;        ///< deg C
  double target = 0;         ///< deg C; 0 is off
  std::optional<int> power;  ///< 0..127, where reported
};

/// " T:20.62 /0.00 B:20.62 /0.00 @:0 B@:0", with " W:9" while the firmware waits for a heater.
struct TemperatureReport {
  std::vector<HeaterReading> heaters;
  bool waiting = false;  ///< a W: was there: the firmware is inside M109 or M190

  /// The heater of that name, or null.
  const HeaterReading* find(const std::string& heater) const;
};

/// "ok", alone or with what the firmware adds to it. `N`, `P` and `B` come with ADVANCED_OK.
struct OkReply {
  std::optional<LineNumber> number;               ///< N: the line that this acknowledges
  std::optional<int> planner_free;                ///< P: free planner blocks
  std::optional<int> queue_free;                  ///< B: free places in the command queue
  std::optional<TemperatureReport> temperatures;  ///< the answer to M105
  bool glued = false;                             ///< found at the end of other text ("File deleted:a.gcook")
};

/// "Resend: 6", "Resend:6", "rs N6": the firmware wants line `number` next.
struct ResendReply {
  LineNumber number = 0;
};

enum class BusyReason { kProcessing, kPausedForUser, kPausedForInput, kOther };

/// "echo:busy: processing": alive, and inside a command.
struct BusyReply {
  BusyReason reason = BusyReason::kOther;
};

/// "wait": alive, and nothing to do.
struct WaitReply {};

/// "start", or the reason that follows it ("PowerUp", "Watchdog Reset"): the firmware has (re)started.
struct StartReply {};

enum class ErrorClass {
  kFatal,     ///< halted, killed: nothing more will run
  kProtocol,  ///< numbering or checksum; a resend request follows
  kWarning    ///< anything else; a normal ok follows
};

/// "Error:..." or "!!".
struct ErrorReply {
  ErrorClass severity = ErrorClass::kWarning;
  std::string text;                     ///< without the "Error:"
  std::optional<LineNumber> last_line;  ///< "Last Line: 5" of a protocol error
};

/// "echo:Unknown command: "G12345"".
struct UnknownCommandReply {
  std::string command;
};

/// "X:50.00 Y:50.00 Z:5.00 E:0.00 Count ...": the planned position, mm.
struct PositionReply {
  double x = 0, y = 0, z = 0, e = 0;
};

/// First line of M115.
struct FirmwareReply {
  std::string firmware;  ///< FIRMWARE_NAME
  std::string machine;   ///< MACHINE_TYPE
  std::optional<int> extruders;
};

/// "Cap:ARCS:1".
struct CapabilityReply {
  std::string name;
  bool present = false;
};

/// "//action:pause", "//action:notification text".
struct HostActionReply {
  std::string action;
  std::string text;
};

/// Any other line, kept for the log.
struct TextReply {
  std::string text;
};

using Reply = std::variant<OkReply, ResendReply, BusyReply, WaitReply, StartReply, ErrorReply,
                           UnknownCommandReply, TemperatureReport, PositionReply, FirmwareReply,
                           CapabilityReply, HostActionReply, TextReply>;

/// What one line from the printer says, `line` without its end. Never throws; what it does not know is a
/// TextReply.
Reply parse_reply(std::string_view line);

/// Puts lines together from bytes as they arrive: ends are \n, \r\n or \r, blank lines vanish, a line without
/// end is cut at `kMaxReplyBytes` so that noise cannot fill the memory.
class ReplyLines {
 public:
  static constexpr std::size_t kMaxReplyBytes = 4096;

  /// Takes bytes, returns the lines that they completed.
  std::vector<std::string> push(std::string_view bytes);

 private:
  std::string partial_;
};

}  // namespace lamina::transport
