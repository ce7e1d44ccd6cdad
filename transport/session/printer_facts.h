#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include "transport/protocol/reply.h"
#include "transport/session/command_filter.h"

namespace lamina::transport {

/// The space that the axes reach, mm.
struct ReachedVolume {
  std::array<double, 3> low{};
  std::array<double, 3> high{};
};

/// What a printer tells of itself (M115).
struct PrinterFacts {
  FirmwareReply firmware;
  std::map<std::string, bool> capabilities;  ///< absent: not there
  std::optional<ReachedVolume> volume;       ///< where M115 has an area

  /// Takes one reply; others than those of M115 change nothing.
  void take(const Reply& reply);

  /// The capability is there.
  bool can(const std::string& capability) const;
};

/// What lines this printer takes. Arcs count as known only if it says so; curves (G5) and skipped objects
/// have no capability of their own in Marlin 2.1, and firmwares without capabilities are asked for nothing
/// special.
FirmwareDialect dialect(const PrinterFacts& facts);

}  // namespace lamina::transport
