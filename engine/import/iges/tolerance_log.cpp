#include "engine/import/iges/tolerance_log.h"

namespace lamina::engine {
namespace {

std::string_view description(Tolerance kind) {
  switch (kind) {
    case Tolerance::kBlankLine:
      return "blank line";
    case Tolerance::kShortLastLine:
      return "last line cut short, left out";
    case Tolerance::kMissingTerminate:
      return "terminate section missing";
    case Tolerance::kTextAfterTerminate:
      return "lines after the terminate section, left out";
    case Tolerance::kTerminateCounts:
      return "terminate section counts other lines than there are";
    case Tolerance::kHollerithCount:
      return "string with a wrong count";
    case Tolerance::kUnitConflict:
      return "units flag and name differ, flag used";
    case Tolerance::kUnitMissing:
      return "units flag missing or out of range";
    case Tolerance::kModelScale:
      return "model space scale not positive, taken as 1";
    case Tolerance::kBlankStatus:
      return "blank status field, taken as visible, independent geometry";
    case Tolerance::kDataInColumn65:
      return "parameter data in column 65";
    case Tolerance::kParameterLineCount:
      return "more parameter lines than the directory says";
    case Tolerance::kBackPointer:
      return "parameter line points to another directory line";
    case Tolerance::kRealWithoutPoint:
      return "real number without a decimal point";
    case Tolerance::kIntegerWithPoint:
      return "integer written as a real number";
    case Tolerance::kSplitNumber:
      return "number continued on the next line";
    case Tolerance::kMissingEnd:
      return "record delimiter missing at the end of an entity";
    case Tolerance::kParameterRange:
      return "parameter range outside the knots or empty, knots used";
    case Tolerance::kUnboundedLine:
      return "unbounded line, taken as the segment between its points";
    case Tolerance::kArcRadius:
      return "arc ends at another radius than it starts, start used";
    case Tolerance::kConicEnds:
      return "end of a conic arc off its conic";
    case Tolerance::kConicForm:
      return "form number of a conic arc differs from its coefficients, these used";
    case Tolerance::kJointGap:
      return "gap between pieces, closed in the middle";
    case Tolerance::kReversedPiece:
      return "piece of a composite curve runs backwards, reversed";
    case Tolerance::kUnusualMatrix:
      return "transformation matrix that is no rotation, used as it is";
    case Tolerance::kRuledByParameter:
      return "rails of a ruled surface joined at equal parameter, not arc length";
    case Tolerance::kTrimGap:
      return "gap in a trim loop, bridged";
    case Tolerance::kTrimCurvesDiffer:
      return "trim curves in parameters and in space differ, these in space used";
    case Tolerance::kTrimOffSurface:
      return "trim curve off its surface, projected";
    case Tolerance::kTrimLost:
      return "face whose trim loops bound no area, left out";
    case Tolerance::kOffsetApproximated:
      return "offset approximated";
    case Tolerance::kCount:
      break;
  }
  return {};
}

}  // namespace

void ToleranceLog::note(Tolerance kind, std::string_view section, std::size_t line, std::string_view detail) {
  ToleratedBreach& breach = breaches_[static_cast<std::size_t>(kind)];
  if (breach.count++ > 0) return;
  breach.what = description(kind);
  if (!detail.empty()) breach.what.append(": ").append(detail);
  breach.section = section;
  breach.line = line;
}

std::vector<ToleratedBreach> ToleranceLog::list() const {
  std::vector<ToleratedBreach> found;
  for (const ToleratedBreach& breach : breaches_) {
    if (breach.count > 0) found.push_back(breach);
  }
  return found;
}

}  // namespace lamina::engine
