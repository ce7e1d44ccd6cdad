#pragma once

#include <optional>
#include <string>
#include <vector>

#include "transport/session/print_header.h"
#include "transport/session/printer_facts.h"

namespace lamina::transport {

/// What the user's profile says of the printer; what is not set is not compared.
struct ExpectedPrinter {
  std::optional<ReachedVolume> volume;
  std::optional<double> hottest_nozzle;  ///< deg C
  std::optional<double> hottest_bed;
};

/// Compares what a file wants with what there is. One sentence for each thing that does not fit; none: print.
/// The printer's own word (M115) goes before the profile's.
std::vector<std::string> mismatches(const PrintHeader& header, const ExpectedPrinter& expected,
                                    const PrinterFacts& facts);

}  // namespace lamina::transport
