#pragma once

#include <cstddef>
#include <deque>

#include "transport/session/journal.h"

namespace lamina::transport {

/// Moves that may wait in the printer after their lines were acknowledged: 16 planner blocks and the one that
/// runs, and some to spare for firmwares with a few more.
inline constexpr std::size_t kMovesInPlanner = 20;

/// Lines that the log keeps at most, moves or not.
inline constexpr std::size_t kMostUnsettled = 160;

/// Follows every numbered line from being sent to being certainly run, and the printer's state with it.
class ExecutionLog {
 public:
  /// Begins behind line `settled`, with the printer in `state` and the source at `position`.
  void begin(LineNumber settled, MachineState state, const SourcePosition& position, FilterState filter,
             int parts);

  /// The next line has got its number. `mark` belongs to a job line.
  void sent(const NumberedLine& line, const SourceMark& mark);

  void acknowledged(LineNumber number);

  /// Behind every line sent.
  const MachineState& printer() const { return printer_; }

  /// Of the source, the last one of which a command was acknowledged; 0: none yet.
  std::int64_t source_line() const { return source_line_; }

  /// Source, port, layer and parking are the caller's.
  JournalRecord& record() { return record_; }
  const JournalRecord& record() const { return record_; }

 private:
  void settle_first();

  JournalRecord record_;
  MachineState printer_;
  std::deque<bool> moving_;  ///< of record_.lines
  std::size_t acknowledged_moves_ = 0;
  std::int64_t source_line_ = 0;
};

}  // namespace lamina::transport
