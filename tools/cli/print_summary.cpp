#include "tools/cli/print_summary.h"

#include <fmt/format.h>

#include "gcode/marlin/time_text.h"

namespace lamina::tools {
namespace {

struct FilamentUse {
  double volume = 0.0;  ///< cm^3
  double mass = 0.0;    ///< g
  double cost = 0.0;
};

FilamentUse filament_use(const gcode::PrintTotals& totals, const gcode::FilamentOptions& filament) {
  const double volume = totals.filament_length * filament.area() / 1000.0;
  const double mass = volume * filament.density;
  return {volume, mass, mass / 1000.0 * filament.cost};
}

}  // namespace

std::string print_summary(const gcode::PrintTotals& totals, const gcode::FilamentOptions& filament) {
  const FilamentUse use = filament_use(totals, filament);
  std::string text = fmt::format("  layers    {}, {:.2f} mm high\n", totals.layers, totals.max_z);
  if (!totals.bounds.isEmpty()) {
    const engine::Vector3 size = totals.bounds.sizes();
    text += fmt::format("  covers    {:.1f} x {:.1f} mm from ({:.1f}, {:.1f}), skirt included\n", size.x(),
                        size.y(), totals.bounds.min().x(), totals.bounds.min().y());
  }
  text += fmt::format("  filament  {:.2f} m, {:.2f} cm^3, {:.1f} g\n", totals.filament_length / 1000.0,
                      use.volume, use.mass);
  text +=
      fmt::format("  time      {}, heating and homing not included\n", gcode::duration_text(totals.seconds));
  return text;
}

Json print_summary_json(const gcode::PrintTotals& totals, const profiles::ResolvedProfile& profile) {
  const gcode::FilamentOptions& filament = profile.settings.gcode.filament;
  const FilamentUse use = filament_use(totals, filament);
  Json json;
  json["printer"] = profile.printer;
  json["filament"] = profile.filament;
  json["quality"] = profile.quality;
  json["layers"] = totals.layers;
  json["height_mm"] = totals.max_z;
  json["bounds_mm"] = to_json(totals.bounds);
  json["planned_volume_mm3"] = totals.volume;
  json["filament_mm"] = totals.filament_length;
  json["filament_cm3"] = use.volume;
  json["filament_g"] = use.mass;
  json["filament_cost"] = use.cost;
  json["seconds"] = totals.seconds;
  json["first_layer_seconds"] = totals.layer_seconds.empty() ? 0.0 : totals.layer_seconds.front();
  return json;
}

}  // namespace lamina::tools
