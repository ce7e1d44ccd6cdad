#include "transport/session/printer_check.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace lamina::transport {

namespace {

constexpr double kSlack = 0.5;  // mm: home offsets and rounding
/// Beds that differ by less are the same bed, measured with and without its clips and margins, mm.
constexpr double kBedSlack = 20;
/// A bed that begins so much farther left or in front has its origin elsewhere (a delta's lies in the
/// middle), mm.
constexpr double kOriginSlack = 50;
constexpr double kHeaterSlack = 0.5;  // deg C

std::string lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

/// Dialects whose files Marlin prints as they are meant.
bool is_for_marlin(const std::string& flavor) {
  const std::string name = lower(flavor);
  constexpr std::array<std::string_view, 6> kMarlin{
      "marlin", "marlin2", "marlin (volumetric)", "repetier", "reprap (marlin/sprinter)", "smoothie"};
  return name.empty() || std::find(kMarlin.begin(), kMarlin.end(), name) != kMarlin.end();
}

}  // namespace

std::vector<std::string> mismatches(const PrintHeader& header, const ExpectedPrinter& expected,
                                    const PrinterFacts& facts) {
  std::vector<std::string> found;
  if (!is_for_marlin(header.flavor)) {
    found.push_back(
        fmt::format("the file is for {} firmware, and this is a printer with Marlin", header.flavor));
  }
  const std::optional<ReachedVolume> volume = facts.volume ? facts.volume : expected.volume;
  constexpr std::array<char, 3> kAxes{'X', 'Y', 'Z'};
  if (volume && header.low && header.high) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if ((*header.low)[axis] >= volume->low[axis] - kSlack &&
          (*header.high)[axis] <= volume->high[axis] + kSlack)
        continue;
      found.push_back(fmt::format(
          "the print reaches from {:.1f} to {:.1f} mm along {}, the printer from {:.1f} "
          "to {:.1f}",
          (*header.low)[axis], (*header.high)[axis], kAxes[axis], volume->low[axis], volume->high[axis]));
    }
  }
  if (volume && header.bed_low && !(header.low && header.high)) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double wanted = (*header.bed_high)[axis] - (*header.bed_low)[axis];
      const double present = volume->high[axis] - volume->low[axis];
      const bool shifted = (*header.bed_low)[axis] < volume->low[axis] - kOriginSlack;
      if (wanted <= present + kBedSlack && !shifted) continue;
      found.push_back(
          fmt::format("the file is for a bed from {:.0f} to {:.0f} mm along {}, this one goes from "
                      "{:.0f} to {:.0f}",
                      (*header.bed_low)[axis], (*header.bed_high)[axis], kAxes[axis], volume->low[axis],
                      volume->high[axis]));
    }
  }
  const auto too_hot = [&](const char* what, std::optional<double> wanted, std::optional<double> most) {
    if (wanted && most && *wanted > *most + kHeaterSlack)
      found.push_back(
          fmt::format("the file wants the {} at {:.0f} C, the printer stands {:.0f}", what, *wanted, *most));
  };
  too_hot("nozzle", header.nozzle, expected.hottest_nozzle);
  too_hot("bed", header.bed, expected.hottest_bed);
  if (header.extruders && facts.firmware.extruders && *header.extruders > *facts.firmware.extruders) {
    found.push_back(fmt::format("the file uses {} extruders, the printer has {}", *header.extruders,
                                *facts.firmware.extruders));
  }
  return found;
}

}  // namespace lamina::transport
