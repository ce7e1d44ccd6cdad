#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "transport/protocol/engine_options.h"
#include "transport/time.h"

namespace lamina::transport {

/// What happened on the wire, as one line of a trace says it.
enum class TraceEvent : char {
  kSent = '>',       ///< bytes that the port took
  kReceived = '<',   ///< bytes that it gave
  kDiscarded = '~',  ///< what waited to be sent or read was thrown away
  kFailed = '!'      ///< the port failed; the bytes are its message
};

struct TraceEntry {
  Instant at;
  TraceEvent event = TraceEvent::kSent;
  std::string bytes;

  friend bool operator==(const TraceEntry&, const TraceEntry&) = default;
};

/// What a replay needs to know besides the bytes.
struct TraceHeader {
  std::string port;  ///< name of the port; for people
  /// Those that a user can change: window, baud, form, meatpack, start_wait. The rest is not written.
  EngineOptions engine;
};

/// A conversation with a printer, byte by byte.
///
/// As text it begins with `lamina trace 1` and a line for each field of the header; then one line for each
/// entry: seconds since the beginning with nine decimals, the event's character, the bytes. Bytes that are
/// not printable ASCII stand as \n, \r, \t or \xHH, a backslash as \\:
///
///     2.500113020 > \nN0 M110 N0*125\n
///     2.503870511 < ok\n
struct Trace {
  TraceHeader header;
  std::vector<TraceEntry> entries;  ///< in the order of time
};

/// A text that is no trace. `what()` says which line, and why.
class TraceError : public std::runtime_error {
 public:
  TraceError(std::size_t line, const std::string& why);

  std::size_t line;  ///< from 1
};

std::string to_text(const TraceHeader& header);

/// Appends the entry's line, with its end, to `text`.
void append_text(std::string& text, const TraceEntry& entry);

std::string to_text(const Trace& trace);

/// The inverse of `to_text`. A last line without its end, as a crash leaves it, is passed over. Throws
/// TraceError.
Trace parse_trace(std::string_view text);

/// `bytes` as they stand in a trace.
std::string escaped(std::string_view bytes);

}  // namespace lamina::transport
