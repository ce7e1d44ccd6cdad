#pragma once

#include <string>

#include "profiles/settings.h"
#include "tools/cli/json.h"
#include "transport/emulator/emulator_options.h"
#include "transport/emulator/print_record.h"

namespace lamina::tools {

/// An emulated printer of the size and the limits that a profile describes.
transport::EmulatorOptions emulated_printer(const profiles::Settings& settings);

/// What the emulated printer did, for people: some indented lines. Faults are listed only where there are
/// any.
std::string report_text(const transport::PrintReport& report);

/// The same for programs.
Json to_json(const transport::PrintReport& report);

}  // namespace lamina::tools
