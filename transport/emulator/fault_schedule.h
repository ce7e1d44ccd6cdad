#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "transport/emulator/fault_order.h"
#include "transport/protocol/line_framing.h"
#include "transport/time.h"

namespace lamina::transport {

/// When which of the ordered faults strikes. All of them strike once, those by chance as often as chance has
/// it.
class FaultSchedule {
 public:
  FaultSchedule(std::vector<FaultOrder> orders, std::uint64_t seed, Instant power_up);

  /// A line of that number has come in: faults of the line's acceptance that wait for it.
  std::vector<FaultOrder> at_arrival(LineNumber number);

  /// A command is about to run: everything else that waits for it, or for the count of commands, or for
  /// chance. `number` is that of its line, if it has one.
  std::vector<FaultOrder> at_command(std::int64_t count, std::optional<LineNumber> number);

  /// What is due by the clock.
  std::vector<FaultOrder> at_time(Instant now);

  /// The next moment for at_time.
  std::optional<Instant> next() const;

 private:
  template <typename Due>
  std::vector<FaultOrder> take(Due due);

  std::vector<FaultOrder> orders_;
  std::mt19937_64 random_;
  Instant power_up_;
};

/// The fault refuses a line that has come in well.
bool refuses_line(FaultKind kind);

}  // namespace lamina::transport
