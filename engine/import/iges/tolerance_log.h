#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/import/import_report.h"

namespace lamina::engine {

/// Breaches of the IGES standard that real files show and that are read all the same.
enum class Tolerance {
  kBlankLine,
  kShortLastLine,
  kMissingTerminate,
  kTextAfterTerminate,
  kTerminateCounts,
  kHollerithCount,
  kUnitConflict,
  kUnitMissing,
  kModelScale,
  kBlankStatus,
  kDataInColumn65,
  kParameterLineCount,
  kBackPointer,
  kRealWithoutPoint,
  kIntegerWithPoint,
  kSplitNumber,
  kMissingEnd,
  kParameterRange,
  kUnboundedLine,
  kArcRadius,
  kConicEnds,
  kConicForm,
  kJointGap,
  kReversedPiece,
  kUnusualMatrix,
  kRuledByParameter,
  kTrimGap,
  kTrimCurvesDiffer,
  kTrimOffSurface,
  kTrimLost,
  kOffsetApproximated,
  kCount
};

/// Counts tolerated breaches by kind and keeps the place of the first.
class ToleranceLog {
 public:
  /// `section` and `line` say where; `detail` is kept from the first time.
  void note(Tolerance kind, std::string_view section, std::size_t line, std::string_view detail = {});

  /// One entry per kind that occurred, in the order of the enumeration.
  std::vector<ToleratedBreach> list() const;

 private:
  std::array<ToleratedBreach, static_cast<std::size_t>(Tolerance::kCount)> breaches_;
};

}  // namespace lamina::engine
