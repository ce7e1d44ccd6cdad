#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "transport/protocol/line_history.h"
#include "transport/session/machine_state.h"
#include "transport/session/source_reader.h"

namespace lamina::transport {

/// A line that the printer has got a number for, as far as the host has come to know.
struct JournalLine {
  std::string command;
  LineOrigin origin = LineOrigin::kJob;
  SourceMark mark;  ///< of a job line; in a decoded record only line, part and last
};

/// What a host must know to go on with a print that another one began. A plain value; it is written down
/// before the lines that it names go out, so whatever line the printer says it took last is in it.
struct JournalRecord {
  /// What is printed and where; only for the user and for a first comparison.
  std::string source;
  std::int64_t source_size = -1;  ///< bytes; -1: not a file
  std::string port;
  int baud = 0;  ///< that the port ran at; 0: not known

  /// The last line that has certainly been run to the end of its move; everything behind it may be lost in
  /// the planner when the printer restarts.
  LineNumber settled = 0;
  MachineState printer;     ///< behind that line
  SourcePosition position;  ///< every source line before it was settled
  int parts = 0;            ///< and so many commands of the next one
  FilterState filter;       ///< at `position`
  FirmwareDialect dialect;  ///< that the commands were made for
  std::int64_t layer = 0;   ///< begun so far; for the user

  /// Lines settled + 1, settled + 2, ... in the order of their numbers.
  std::deque<JournalLine> lines;
  LineNumber acknowledged = 0;  ///< of those, up to here

  /// How the print ended; empty: it has not.
  std::string ended;

  /// The print was parked: the printer's state to go back to.
  std::optional<MachineState> parked_from;

  /// The number of the last line in the record.
  LineNumber last() const { return settled + static_cast<LineNumber>(lines.size()); }
};

/// A journal that is damaged, or of a version that is not known.
class JournalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// As text, one "key value" a line.
std::string encode(const JournalRecord& record);

/// The inverse. Throws JournalError.
JournalRecord decode(std::string_view text);

}  // namespace lamina::transport
