#pragma once

#include <string>
#include <vector>

#include "gcode/gcode_options.h"
#include "gcode/print_totals.h"

namespace lamina::gcode {

/// The comments after the end G-code: filament, layers, times and the block of settings, under the keys that
/// Moonraker, OctoPrint and PrusaSlicer's viewer look for. Lines carry no line feed.
std::vector<std::string> statistics_lines(const GcodeOptions& options, const PrintTotals& totals);

}  // namespace lamina::gcode
