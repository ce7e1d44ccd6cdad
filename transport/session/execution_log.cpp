#include "transport/session/execution_log.h"

#include <utility>

#include "transport/protocol/command_class.h"

namespace lamina::transport {

namespace {

bool has_moved(const MachineState& before, const MachineState& now, const std::string& command) {
  if (classify(command) != CommandClass::kMotion) return false;
  // A curve may end where it began; and where nobody knows the place, anything may be a move.
  const std::string_view code = command_word(command);
  const bool straight = code == "G0" || code == "G1";
  const bool known = before.position[0] && before.position[1] && before.position[2];
  return !straight || !known || before.position != now.position || before.e_total != now.e_total;
}

}  // namespace

void ExecutionLog::begin(LineNumber settled, MachineState state, const SourcePosition& position,
                         FilterState filter, int parts) {
  record_.settled = settled;
  record_.acknowledged = settled;
  record_.position = position;
  record_.filter = std::move(filter);
  record_.parts = parts;
  record_.lines.clear();
  moving_.clear();
  acknowledged_moves_ = 0;
  record_.printer = state;
  printer_ = std::move(state);
}

void ExecutionLog::sent(const NumberedLine& line, const SourceMark& mark) {
  MachineState now = after(printer_, line.command);
  moving_.push_back(has_moved(printer_, now, line.command));
  printer_ = std::move(now);
  record_.lines.push_back({line.command, line.origin, mark});
}

void ExecutionLog::acknowledged(LineNumber number) {
  if (number <= record_.acknowledged || number > record_.last()) return;
  while (record_.acknowledged < number) {
    const auto at = static_cast<std::size_t>(record_.acknowledged - record_.settled);
    acknowledged_moves_ += moving_[at] ? 1 : 0;
    if (record_.lines[at].origin == LineOrigin::kJob) source_line_ = record_.lines[at].mark.line;
    ++record_.acknowledged;
  }
  const std::string& command = record_.lines[static_cast<std::size_t>(number - record_.settled) - 1].command;
  if (waits_for_moves(command)) {
    while (record_.settled < number) settle_first();
  }
  while (record_.settled < record_.acknowledged &&
         (acknowledged_moves_ > kMovesInPlanner || record_.lines.size() > kMostUnsettled)) {
    settle_first();
  }
}

void ExecutionLog::settle_first() {
  const JournalLine& line = record_.lines.front();
  record_.printer = after(std::move(record_.printer), line.command);
  if (line.origin == LineOrigin::kJob) {
    if (line.mark.last) {
      record_.position = line.mark.after;
      if (line.mark.filter_after) record_.filter = *line.mark.filter_after;
      record_.parts = 0;
    } else {
      record_.parts = line.mark.part + 1;
    }
  }
  acknowledged_moves_ -= moving_.front() ? 1 : 0;
  moving_.pop_front();
  record_.lines.pop_front();
  ++record_.settled;
}

}  // namespace lamina::transport
