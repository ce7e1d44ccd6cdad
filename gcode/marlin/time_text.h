#pragma once

#include <cstdint>
#include <string>

namespace lamina::gcode {

/// A duration in the words of slicers: "1d 2h 3m 4s", leading zero units left out, "0s" for nothing.
std::string duration_text(double seconds);

/// "YYYY-MM-DD at HH:MM:SS UTC" of seconds since 1970-01-01 00:00:00 UTC, which must not be negative.
std::string timestamp_text(std::int64_t seconds);

}  // namespace lamina::gcode
