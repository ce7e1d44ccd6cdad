#pragma once

#include <string_view>

#include "transport/protocol/line_framing.h"

namespace lamina::transport {

/// What Marlin does with a line that it has read.
enum class Verdict {
  kAccepted,
  kDuplicate,        ///< received before: dropped without a word
  kNotNextLine,      ///< "Line Number is not Last Line Number+1"
  kNoChecksum,       ///< "No Checksum with line number"
  kChecksumMismatch  ///< "checksum mismatch"
};

/// Marlin's numbering: line n is taken only as the one after the last. Lines without a number are not checked
/// at all.
class LineAcceptance {
 public:
  /// `silent_duplicates`: the last two lines are dropped silently when they come again (Marlin since 2.1.2).
  explicit LineAcceptance(bool silent_duplicates) : silent_duplicates_(silent_duplicates) {}

  /// Judges `line` (no leading blanks) and, when it is accepted, counts it.
  Verdict judge(std::string_view line);

  LineNumber last_line() const { return last_line_; }
  void set_last_line(LineNumber number) { last_line_ = number; }

 private:
  bool silent_duplicates_;
  LineNumber last_line_ = 0;
};

}  // namespace lamina::transport
