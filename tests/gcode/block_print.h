#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gcode/gcode_stream.h"
#include "tests/gcode/shapes.h"

namespace lamina::tests {

inline constexpr double kThickness = 0.2;

inline gcode::GcodeOptions printer_options() {
  gcode::GcodeOptions options;
  options.marlin.timestamp = 1769860800;  // 2026-01-31 12:00:00 UTC
  options.marlin.templates.start =
      "M140 S{first_layer_bed}\nM104 S{idle_nozzle}\nG28\nM190 S{first_layer_bed}\nM109 "
      "S{first_layer_nozzle}\n"
      "G90\nM83\nG1 Z0.3 F600\nG1 X2 Y20 F6000\nG1 X2 Y100 E8 F1200\nG92 E0\n";
  options.marlin.templates.end =
      "G1 E-2 F2400\nG1 Z{min(max_z + 10, bed_z)} F600\nM104 S0\nM140 S0\nM107\nM84 X Y E\n";
  return options;
}

using Lines = std::vector<std::string>;

struct Print {
  Lines lines;
  gcode::PrintTotals totals;
};

/// A block with a bore that steps in on its upper half.
inline std::vector<engine::Layer> stepped_block(std::size_t count) {
  std::vector<engine::Layer> layers;
  for (std::size_t i = 0; i < count; ++i) {
    const double side = i < count / 2 ? 30.0 : 22.0;
    layers.push_back(layer_of(i, kThickness, {square({110, 110}, side), circle({110, 110}, 5, 90)}));
  }
  return layers;
}

inline gcode::PrintOutline outline_of(std::size_t count) {
  return {engine::Box3(engine::Vector3(95, 95, 0),
                       engine::Vector3(125, 125, kThickness * static_cast<double>(count))),
          count};
}

inline void append(Lines& lines, const Lines& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

inline Print print(const gcode::GcodeOptions& options, const std::vector<engine::Layer>& layers) {
  gcode::GcodeStream stream(options, outline_of(layers.size()));
  Print result{stream.begin(), {}};
  for (const engine::Layer& layer : layers) append(result.lines, stream.push(layer));
  append(result.lines, stream.finish());
  result.totals = stream.totals();
  return result;
}

inline std::string joined(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

}  // namespace lamina::tests
