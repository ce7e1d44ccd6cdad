#include "gcode/marlin/statistics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gcode/marlin/number_text.h"
#include "gcode/marlin/time_text.h"

namespace lamina::gcode {
namespace {

constexpr double kMm3PerCm3 = 1000.0;
constexpr double kGramsPerKilogram = 1000.0;
constexpr int kCircleCorners = 32;

std::string entry(const std::string& key, const std::string& value) {
  std::string line = "; " + key + " = ";
  for (const char c : value) {
    if (c == '\n')
      line += "\\n";  // one line for each key
    else if (c != '\r')
      line += c;
  }
  return line;
}

std::string entry(const std::string& key, double value) {
  return entry(key, number_text(value, 3));
}

std::string corner_text(double x, double y) {
  return number_text(x, 3) + "x" + number_text(y, 3);
}

std::string bed_shape(const PrintVolume& volume) {
  const engine::Box3 box = volume.bounds();
  if (volume.shape == BedShape::kRectangle) {
    const engine::Vector3& low = box.min();
    const engine::Vector3& high = box.max();
    return corner_text(low.x(), low.y()) + "," + corner_text(high.x(), low.y()) + "," +
           corner_text(high.x(), high.y()) + "," + corner_text(low.x(), high.y());
  }
  std::string text;
  const engine::Vector3 center = volume.center();
  for (int i = 0; i < kCircleCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCircleCorners;
    if (i > 0) text += ',';
    text += corner_text(center.x() + 0.5 * volume.width * std::cos(angle),
                        center.y() + 0.5 * volume.width * std::sin(angle));
  }
  return text;
}

void append_settings(const GcodeOptions& options, std::vector<std::string>& lines) {
  const MarlinOptions& marlin = options.marlin;
  const FilamentOptions& filament = options.filament;
  lines.push_back(entry("layer_height", marlin.layer_height));
  lines.push_back(entry("first_layer_height", marlin.first_layer_height));
  lines.push_back(entry("nozzle_diameter", marlin.nozzle_diameter));
  lines.push_back(entry("bed_shape", bed_shape(options.volume)));
  lines.push_back(entry("max_print_height", options.volume.height));
  lines.push_back(entry("printer_model", marlin.printer_model));
  lines.push_back(entry("printer_vendor", marlin.printer_vendor));
  lines.push_back(entry("printer_settings_id", marlin.printer_name));
  lines.push_back(entry("print_settings_id", marlin.quality_name));
  lines.push_back(entry("filament_settings_id", filament.name));
  lines.push_back(entry("filament_type", filament.type));
  lines.push_back(entry("filament_vendor", filament.vendor));
  lines.push_back(entry("filament_colour", filament.color));
  lines.push_back(entry("filament_diameter", filament.diameter));
  lines.push_back(entry("filament_density", filament.density));
  lines.push_back(entry("filament_cost", filament.cost));
  lines.push_back(entry("temperature", marlin.temperature.nozzle));
  lines.push_back(entry("first_layer_temperature", marlin.temperature.nozzle_first_layer));
  lines.push_back(entry("bed_temperature", marlin.temperature.bed));
  lines.push_back(entry("first_layer_bed_temperature", marlin.temperature.bed_first_layer));
  lines.push_back(entry("chamber_temperature", marlin.temperature.chamber));
  lines.push_back(entry("referenced_tools", "0"));
  for (const auto& [key, value] : marlin.config) lines.push_back(entry(key, value));
}

}  // namespace

std::vector<std::string> statistics_lines(const GcodeOptions& options, const PrintTotals& totals) {
  const FilamentOptions& filament = options.filament;
  const double volume = totals.filament_length * filament.area() / kMm3PerCm3;
  const double mass = volume * filament.density;
  const double cost = mass / kGramsPerKilogram * filament.cost;
  const double first_layer = totals.layer_seconds.empty() ? 0.0 : totals.layer_seconds.front();

  std::vector<std::string> lines;
  lines.push_back("; filament used [mm] = " + fixed_text(totals.filament_length, 2));
  lines.push_back("; filament used [cm3] = " + fixed_text(volume, 2));
  lines.push_back("; filament used [g] = " + fixed_text(mass, 2));
  lines.push_back("; filament cost = " + fixed_text(cost, 2));
  lines.push_back("; total filament used [g] = " + fixed_text(mass, 2));
  lines.push_back("; total filament cost = " + fixed_text(cost, 2));
  lines.push_back("; total layers count = " + std::to_string(totals.layers));
  lines.push_back("; estimated printing time (normal mode) = " + duration_text(totals.seconds));
  lines.push_back("; estimated first layer printing time (normal mode) = " + duration_text(first_layer));
  lines.push_back("; " + options.marlin.generator + "_config = begin");
  append_settings(options, lines);
  lines.push_back("; " + options.marlin.generator + "_config = end");
  return lines;
}

}  // namespace lamina::gcode
