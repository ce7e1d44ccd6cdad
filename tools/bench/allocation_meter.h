#pragma once

namespace lamina::tools {

/// Megabytes that the program has asked for so far, freed ones included. Counts in programs that link
/// allocation_meter.cpp, whose operators new and delete take the place of the standard ones.
double allocated_megabytes();

}  // namespace lamina::tools
