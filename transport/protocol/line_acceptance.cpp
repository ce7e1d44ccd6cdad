#include "transport/protocol/line_acceptance.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>

namespace lamina::transport {

namespace {

/// The number at the start of `text` after blanks, as C's strtol reads it on printers: 0 where there is none,
/// and not beyond 32 bits.
LineNumber number_at(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  LineNumber number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return std::clamp<LineNumber>(number, std::numeric_limits<std::int32_t>::min(),
                                std::numeric_limits<std::int32_t>::max());
}

}  // namespace

Verdict LineAcceptance::judge(std::string_view line) {
  if (!line.starts_with('N')) return Verdict::kAccepted;

  const bool sets_number = line.find("M110") != std::string_view::npos;
  std::size_t number_mark = 0;
  if (sets_number) {
    const std::size_t second = line.find('N', 4);
    if (second != std::string_view::npos) number_mark = second;
  }
  const LineNumber number = number_at(line.substr(number_mark + 1));
  if (!sets_number && number != last_line_ + 1) {
    const bool duplicate = number == last_line_ || number == last_line_ - 1;
    return duplicate && silent_duplicates_ ? Verdict::kDuplicate : Verdict::kNotNextLine;
  }
  const std::size_t star = line.rfind('*');
  if (star == std::string_view::npos) return Verdict::kNoChecksum;
  if (number_at(line.substr(star + 1)) != checksum(line.substr(0, star))) return Verdict::kChecksumMismatch;
  last_line_ = number;
  return Verdict::kAccepted;
}

}  // namespace lamina::transport
