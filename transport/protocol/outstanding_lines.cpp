#include "transport/protocol/outstanding_lines.h"

#include <algorithm>

namespace lamina::transport {

std::optional<OutstandingLine> OutstandingLines::acknowledge_oldest() {
  if (lines_.empty() || lines_.front().reports_temperature || lines_.front().held) return std::nullopt;
  return take(1).front();
}

std::vector<OutstandingLine> OutstandingLines::acknowledge_up_to(LineNumber number) {
  const auto found = std::find_if(lines_.begin(), lines_.end(),
                                  [&](const OutstandingLine& line) { return line.number == number; });
  if (found == lines_.end()) return {};
  return take(static_cast<std::size_t>(found - lines_.begin()) + 1);
}

std::vector<OutstandingLine> OutstandingLines::acknowledge_temperature_report() {
  const auto found = std::find_if(lines_.begin(), lines_.end(),
                                  [](const OutstandingLine& line) { return line.reports_temperature; });
  if (found == lines_.end()) return {};
  return take(static_cast<std::size_t>(found - lines_.begin()) + 1);
}

void OutstandingLines::keep_below(LineNumber next) {
  std::erase_if(lines_, [&](const OutstandingLine& line) { return !line.number || *line.number >= next; });
  for (OutstandingLine& line : lines_) line.accepted = true;
}

std::vector<OutstandingLine> OutstandingLines::release_accepted(bool also_blocking) {
  const auto first_kept = std::find_if(lines_.begin(), lines_.end(), [&](const OutstandingLine& line) {
    return !line.accepted || (!also_blocking && line.command_class == CommandClass::kBlocking);
  });
  return take(static_cast<std::size_t>(first_kept - lines_.begin()));
}

void OutstandingLines::forget_questions() {
  std::erase_if(lines_,
                [](const OutstandingLine& line) { return line.accepted && line.reports_temperature; });
}

void OutstandingLines::release_last(Instant now, Instant left) {
  lines_.back().held = false;
  lines_.back().ended = now;
  lines_.back().left = left;
}

std::size_t OutstandingLines::unaccepted_lines() const {
  return static_cast<std::size_t>(std::count_if(lines_.begin(), lines_.end(),
                                                [](const OutstandingLine& line) { return !line.accepted; }));
}

std::size_t OutstandingLines::unaccepted_bytes() const {
  std::size_t bytes = 0;
  for (const OutstandingLine& line : lines_) bytes += line.accepted ? 0 : line.bytes;
  return bytes;
}

std::vector<OutstandingLine> OutstandingLines::take(std::size_t count) {
  const auto end = lines_.begin() + static_cast<std::ptrdiff_t>(count);
  std::vector<OutstandingLine> taken(lines_.begin(), end);
  lines_.erase(lines_.begin(), end);
  return taken;
}

}  // namespace lamina::transport
