#pragma once

#include <string>

#include "gcode/print_totals.h"
#include "profiles/resolve.h"
#include "tools/cli/json.h"

namespace lamina::tools {

/// What a sliced print adds up to, for people: some indented lines.
std::string print_summary(const gcode::PrintTotals& totals, const gcode::FilamentOptions& filament);

/// The same and more for programs.
Json print_summary_json(const gcode::PrintTotals& totals, const profiles::ResolvedProfile& profile);

}  // namespace lamina::tools
