#pragma once

#include <string>

#include "profiles/settings.h"
#include "tools/cli/json.h"
#include "transport/emulator/emulator_options.h"
#include "transport/emulator/print_record.h"

namespace lamina::tools {

/// An emulated printer of the size and the limits that a profile describes.
transport::EmulatorOptions emulated_printer(const profiles::Settings& settings);

/// Switches what the firmware can do: names as in firmware_feature_names, "no-" before one switches it off.
/// Throws Failure (kUsage).
void switch_feature(transport::FirmwareFeatures& features, const std::string& name);

/// All of them, separated by commas.
std::string firmware_feature_names();

/// What the emulated printer did, for people: some indented lines. Faults are listed only where there are
/// any.
std::string report_text(const transport::PrintReport& report);

/// The same for programs.
Json to_json(const transport::PrintReport& report);

}  // namespace lamina::tools
