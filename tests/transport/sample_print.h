#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "transport/session/print_job.h"

namespace lamina::tests {

/// A small print with everything in it: heating, homing, retractions, chords of a circle, a blocking command
/// in the middle. `chords` moves extrude.
inline std::vector<std::string> sample_print(int chords) {
  std::vector<std::string> lines{
      "; sample", "G90",       "M83",    "G21",       "M140 S60",     "M104 S200",       "G28 ; home",
      "M190 S60", "M109 S200", "G92 E0", "M106 S255", "G1 Z0.2 F600", "G1 X60 Y50 F6000"};
  for (int i = 1; i <= chords; ++i) {
    const double angle = i * 2 * std::numbers::pi / 60;
    lines.push_back(fmt::format("G1 X{:.3f} Y{:.3f} E{:.5f}{}", 50 + 10 * std::cos(angle),
                                50 + 10 * std::sin(angle), 0.03 + 0.001 * (i % 7), i == 1 ? " F1800" : ""));
    if (i % 60 == 0) {
      lines.push_back("G1 E-0.8 F2100");
      lines.push_back(fmt::format("G1 Z{:.2f} F600 ; up", 0.2 + 0.2 * (i / 60)));
      lines.push_back("G1 E0.8 F2100");
      lines.push_back("G1 F1800");
    }
    if (i % 150 == 0) lines.push_back("M400");
  }
  lines.insert(lines.end(), {"M107", "M104 S0", "M140 S0", "M84"});
  return lines;
}

inline transport::LineSource source_of(std::vector<std::string> lines) {
  return [lines = std::move(lines), next = std::size_t{0}]() mutable -> std::optional<std::string> {
    if (next == lines.size()) return std::nullopt;
    return lines[next++];
  };
}

}  // namespace lamina::tests
