#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "transport/protocol/protocol_engine.h"
#include "transport/trace/trace.h"

namespace lamina::transport {

/// Where a replay parts from its trace.
struct ReplayDifference {
  Instant at;                 ///< in the trace
  std::int64_t position = 0;  ///< of the first byte that differs, among all bytes sent
  std::string before;         ///< the end of what both sent before it
  std::string traced;         ///< what was sent from there on; empty: nothing in that time
  std::string replayed;       ///< what the engine sends now; empty: nothing in that time
};

struct ReplayEvent {
  Instant at;
  Event event;
};

struct ReplayResult {
  std::optional<ReplayDifference> difference;  ///< none: the engine sends what was sent, byte for byte
  std::int64_t bytes_sent = 0;                 ///< in the trace, up to the difference
  std::int64_t bytes_received = 0;
  Duration span{};  ///< from the beginning to the last entry that was replayed
  EngineStatistics statistics;
  std::vector<ReplayEvent> events;  ///< of the engine, as they came
};

/// Feeds the protocol engine what the printer said in a trace, at the same times, and compares what it sends
/// with what was sent then. The commands come from the trace, too: each is submitted when it was first sent;
/// everything that the engine decides by itself (greeting, window, going back, probes, packing) must come
/// out of it anew. Ends at the first difference. Same trace, same result.
///
/// Bytes are compared as a stream. The engine must have given what was sent by the time it was sent, but for
/// some milliseconds, because a trace tells when a port took bytes, not when the engine's clock was read; the
/// port may have taken it up to half a second later.
ReplayResult replay(const Trace& trace);

}  // namespace lamina::transport
