#include "profiles/key_table.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "profiles/key_group.h"
#include "profiles/nearest_name.h"

namespace lamina::profiles {
namespace {

using engine::AdaptiveOptions;
using engine::SliceOptions;
using engine::SlicingPlanesOptions;
using gcode::AccelerationOptions;
using gcode::AdhesionOptions;
using gcode::AxisValues;
using gcode::CoolingOptions;
using gcode::FilamentOptions;
using gcode::FirmwareFeatures;
using gcode::InfillOptions;
using gcode::MachineLimits;
using gcode::MarlinOptions;
using gcode::PlanOptions;
using gcode::PrintVolume;
using gcode::RegionOptions;
using gcode::RetractionOptions;
using gcode::ShellOptions;
using gcode::SpeedOptions;
using gcode::TemperatureOptions;
using gcode::TemplateOptions;
using gcode::WallOptions;
using gcode::WidthOptions;
using transport::PortOptions;

constexpr Bounds above(double low, double high) {
  return {low, high, true};
}
constexpr Bounds within(double low, double high) {
  return {low, high, false};
}

constexpr Bounds kPercent = within(0.0, 100.0);
constexpr Bounds kWidth = above(0.0, 10.0);
constexpr Bounds kSpeed = above(0.0, 2000.0);
constexpr Bounds kAcceleration = within(0.0, 100000.0);
constexpr Bounds kLayers = within(0.0, 100000.0);
constexpr Bounds kNozzleTemperature = within(0.0, 500.0);
constexpr Bounds kBedTemperature = within(0.0, 200.0);

std::vector<Key> slicing_keys() {
  const KeyGroup<SlicingPlanesOptions> layer{"layer",
                                             [](Settings& s) -> SlicingPlanesOptions& { return s.planes; }};
  const KeyGroup<AdaptiveOptions> adaptive{"layer",
                                           [](Settings& s) -> AdaptiveOptions& { return s.planes.adaptive; }};
  const KeyGroup<SliceOptions> slicing{"slicing", [](Settings& s) -> SliceOptions& { return s.slice; }};
  const KeyGroup<SlicingPlanesOptions> planes{"slicing",
                                              [](Settings& s) -> SlicingPlanesOptions& { return s.planes; }};
  const KeyGroup<RegionOptions> region{"region",
                                       [](Settings& s) -> RegionOptions& { return s.gcode.region; }};
  return {
      layer.number("height", &SlicingPlanesOptions::layer_thickness, "mm", above(0.0, 10.0),
                   "layer thickness"),
      layer.number("first_height", &SlicingPlanesOptions::first_layer_thickness, "mm", within(0.0, 10.0),
                   "thickness of the first layer; 0 = as the others"),
      adaptive.boolean("adaptive", &AdaptiveOptions::enabled, "thickness follows the slope of the surface"),
      adaptive.number("least_height", &AdaptiveOptions::least_thickness, "mm", above(0.0, 10.0),
                      "thinnest adaptive layer"),
      adaptive.number("greatest_height", &AdaptiveOptions::greatest_thickness, "mm", above(0.0, 10.0),
                      "thickest adaptive layer"),
      adaptive.number("cusp_height", &AdaptiveOptions::cusp_height, "mm", above(0.0, 10.0),
                      "greatest distance of adaptive layers' edges from the surface"),
      adaptive.number("greatest_ratio", &AdaptiveOptions::greatest_ratio, "", above(1.0, 10.0),
                      "of neighbouring adaptive layers"),
      slicing.number("tolerance", &SliceOptions::epsilon, "mm", within(0.0001, 10.0),
                     "cell size and accuracy inside a layer"),
      slicing.integer("degree", &SliceOptions::greatest_degree, "", within(2, 5),
                      "of the fitted curves, at most"),
      slicing.number("longest_bridge", &SliceOptions::longest_bridge, "mm", within(0.0, 100.0),
                     "gaps in the model up to this are closed and reported"),
      slicing.choice("containment", &SliceOptions::containment, {"nominal", "positive", "negative"},
                     "what a layer stands for: its plane, all sections of its slab, or what they share"),
      planes.choice("position", &SlicingPlanesOptions::position, {"bottom", "middle", "top"},
                    "where a plane cuts its layer"),
      region.number("tolerance", &RegionOptions::tolerance, "mm", above(0.0, 1.0),
                    "chord error of filled areas"),
      region.number("xy_compensation", &RegionOptions::xy_compensation, "mm", within(-5.0, 5.0),
                    "grows (or shrinks) every layer in the plane"),
      region.number("elephant_foot", &RegionOptions::elephant_foot, "mm", within(0.0, 5.0),
                    "shrinks the first layer"),
  };
}

std::vector<Key> path_keys() {
  const KeyGroup<WidthOptions> width{"width",
                                     [](Settings& s) -> WidthOptions& { return s.gcode.plan.width; }};
  const KeyGroup<WallOptions> wall{"wall", [](Settings& s) -> WallOptions& { return s.gcode.plan.wall; }};
  const KeyGroup<ShellOptions> shell{"shell",
                                     [](Settings& s) -> ShellOptions& { return s.gcode.plan.shell; }};
  const KeyGroup<InfillOptions> infill{"infill",
                                       [](Settings& s) -> InfillOptions& { return s.gcode.plan.infill; }};
  const KeyGroup<AdhesionOptions> adhesion{
      "adhesion", [](Settings& s) -> AdhesionOptions& { return s.gcode.plan.adhesion; }};
  return {
      width.number("first_layer", &WidthOptions::first_layer, "mm", within(0.0, 10.0),
                   "every bead of the first layer; 0 = the role's own"),
      width.number("outer_wall", &WidthOptions::outer_wall, "mm", kWidth, "bead width"),
      width.number("inner_wall", &WidthOptions::inner_wall, "mm", kWidth, "bead width"),
      width.number("sparse_infill", &WidthOptions::sparse_infill, "mm", kWidth, "bead width"),
      width.number("solid_infill", &WidthOptions::solid_infill, "mm", kWidth, "bead width"),
      width.number("top_surface", &WidthOptions::top_surface, "mm", kWidth, "bead width"),

      wall.integer("loops", &WallOptions::loops, "", within(0, 1000), "walls around every region"),
      wall.choice("order", &WallOptions::order, {"inner_first", "outer_first"},
                  "which wall is printed first"),
      wall.choice("seam", &WallOptions::seam, {"aligned", "rear", "nearest"}, "where a wall starts and ends"),

      shell.integer("top_layers", &ShellOptions::top_layers, "layers", kLayers, "solid below a top surface"),
      shell.integer("bottom_layers", &ShellOptions::bottom_layers, "layers", kLayers,
                    "solid above a bottom surface"),
      shell.number("top_min_thickness", &ShellOptions::top_min_thickness, "mm", within(0.0, 100.0),
                   "solid at least so deep below a top surface"),
      shell.number("bottom_min_thickness", &ShellOptions::bottom_min_thickness, "mm", within(0.0, 100.0),
                   "solid at least so deep above a bottom surface"),

      infill.percent("density", &InfillOptions::density, kPercent, "filled share of the inside"),
      infill.choice("pattern", &InfillOptions::pattern, {"lines", "grid"}, "of sparse infill"),
      infill.number("angle", &InfillOptions::angle, "deg", within(-360.0, 360.0),
                    "of the lines on even layers"),
      infill.percent("wall_overlap", &InfillOptions::wall_overlap, kPercent,
                     "of a line's width that it runs into the wall"),
      infill.number("anchor_max", &InfillOptions::anchor_max, "mm", within(0.0, 1000.0),
                    "longest way along the wall that joins two lines"),
      infill.number("min_area_solid", &InfillOptions::min_area_solid, "mm^2", within(0.0, 1e6),
                    "smaller sparse areas become solid"),

      adhesion.choice("type", &AdhesionOptions::type, {"none", "skirt", "brim"}, "around the first layer"),
      adhesion.integer("skirt_loops", &AdhesionOptions::skirt_loops, "", within(0, 1000),
                       "lines around the model"),
      adhesion.number("skirt_distance", &AdhesionOptions::skirt_distance, "mm", within(0.0, 200.0),
                      "from the model to the skirt"),
      adhesion.integer("skirt_height", &AdhesionOptions::skirt_height, "layers", kLayers,
                       "height of the skirt"),
      adhesion.number("skirt_min_length", &AdhesionOptions::skirt_min_length, "mm", within(0.0, 10000.0),
                      "filament that the skirt takes at least"),
      adhesion.number("brim_width", &AdhesionOptions::brim_width, "mm", within(0.0, 200.0),
                      "width of the brim"),
      adhesion.number("brim_gap", &AdhesionOptions::brim_gap, "mm", within(0.0, 10.0),
                      "between model and brim"),
  };
}

std::vector<Key> motion_keys() {
  const KeyGroup<SpeedOptions> speed{"speed",
                                     [](Settings& s) -> SpeedOptions& { return s.gcode.plan.speed; }};
  const KeyGroup<AccelerationOptions> acceleration{
      "acceleration", [](Settings& s) -> AccelerationOptions& { return s.gcode.plan.acceleration; }};
  const KeyGroup<RetractionOptions> retraction{
      "retraction", [](Settings& s) -> RetractionOptions& { return s.gcode.plan.retraction; }};
  return {
      speed.number("outer_wall", &SpeedOptions::outer_wall, "mm/s", kSpeed, "speed"),
      speed.number("inner_wall", &SpeedOptions::inner_wall, "mm/s", kSpeed, "speed"),
      speed.number("sparse_infill", &SpeedOptions::sparse_infill, "mm/s", kSpeed, "speed"),
      speed.number("solid_infill", &SpeedOptions::solid_infill, "mm/s", kSpeed, "speed"),
      speed.number("top_surface", &SpeedOptions::top_surface, "mm/s", kSpeed, "speed"),
      speed.number("skirt", &SpeedOptions::skirt, "mm/s", kSpeed, "speed, of the brim too"),
      speed.number("travel", &SpeedOptions::travel, "mm/s", kSpeed, "speed"),
      speed.number("travel_z", &SpeedOptions::travel_z, "mm/s", within(0.0, 2000.0),
                   "speed up and down; 0 = the machine's limit"),
      speed.number("first_layer", &SpeedOptions::first_layer, "mm/s", kSpeed,
                   "highest of every extruding move of the first layer"),
      speed.number("first_layer_travel", &SpeedOptions::first_layer_travel, "mm/s", kSpeed,
                   "highest of travel on the first layer"),

      acceleration.number("outer_wall", &AccelerationOptions::outer_wall, "mm/s^2", kAcceleration,
                          "0 = the machine's own"),
      acceleration.number("inner_wall", &AccelerationOptions::inner_wall, "mm/s^2", kAcceleration,
                          "0 = the machine's own"),
      acceleration.number("infill", &AccelerationOptions::infill, "mm/s^2", kAcceleration,
                          "0 = the machine's own"),
      acceleration.number("first_layer", &AccelerationOptions::first_layer, "mm/s^2", kAcceleration,
                          "0 = the machine's own"),
      acceleration.number("travel", &AccelerationOptions::travel, "mm/s^2", kAcceleration,
                          "0 = the machine's own"),

      retraction.number("length", &RetractionOptions::length, "mm", within(0.0, 100.0),
                        "of filament; 0 = never"),
      retraction.number("speed", &RetractionOptions::speed, "mm/s", kSpeed, "drawing back"),
      retraction.number("recover_speed", &RetractionOptions::recover_speed, "mm/s", within(0.0, 2000.0),
                        "pushing out again; 0 = as drawing back"),
      retraction.number("restart_extra", &RetractionOptions::restart_extra, "mm", within(-10.0, 10.0),
                        "of filament pushed out beyond what was drawn back"),
      retraction.number("z_hop", &RetractionOptions::z_hop, "mm", within(0.0, 20.0), "lift while travelling"),
      retraction.number("z_hop_max_z", &RetractionOptions::z_hop_max_z, "mm", within(0.0, 10000.0),
                        "no lift above this height; 0 = lift everywhere"),
      retraction.number("min_travel", &RetractionOptions::min_travel, "mm", within(0.0, 1000.0),
                        "shorter travel needs no retraction"),
      retraction.boolean("on_layer_change", &RetractionOptions::on_layer_change,
                         "retract when the layer changes"),
  };
}

std::vector<Key> filament_keys() {
  const KeyGroup<FilamentOptions> filament{"filament",
                                           [](Settings& s) -> FilamentOptions& { return s.gcode.filament; }};
  const KeyGroup<TemperatureOptions> temperature{
      "temperature", [](Settings& s) -> TemperatureOptions& { return s.gcode.marlin.temperature; }};
  const KeyGroup<CoolingOptions> cooling{"cooling",
                                         [](Settings& s) -> CoolingOptions& { return s.gcode.cooling; }};
  return {
      filament.text("type", &FilamentOptions::type, "material class"),
      filament.text("vendor", &FilamentOptions::vendor, "who made it"),
      filament.text("color", &FilamentOptions::color, "#RRGGBB"),
      filament.number("diameter", &FilamentOptions::diameter, "mm", within(0.5, 5.0), "of the strand"),
      filament.number("density", &FilamentOptions::density, "g/cm^3", within(0.1, 20.0), "mass per volume"),
      filament.number("cost", &FilamentOptions::cost, "per kg", within(0.0, 1e6), "price"),
      filament.number("flow", &FilamentOptions::flow, "", within(0.1, 3.0),
                      "filament fed per planned volume"),
      filament.number("max_volumetric_speed", &FilamentOptions::max_volumetric_speed, "mm^3/s",
                      within(0.0, 1000.0), "what the hot end melts; 0 = no limit"),

      temperature.number("nozzle_first_layer", &TemperatureOptions::nozzle_first_layer, "C",
                         kNozzleTemperature, "nozzle on the first layer"),
      temperature.number("nozzle", &TemperatureOptions::nozzle, "C", kNozzleTemperature, "nozzle"),
      temperature.number("nozzle_idle", &TemperatureOptions::nozzle_idle, "C", kNozzleTemperature,
                         "nozzle while homing and waiting for the bed"),
      temperature.number("bed_first_layer", &TemperatureOptions::bed_first_layer, "C", kBedTemperature,
                         "bed on the first layer"),
      temperature.number("bed", &TemperatureOptions::bed, "C", kBedTemperature, "bed"),
      temperature.number("chamber", &TemperatureOptions::chamber, "C", kBedTemperature,
                         "chamber; 0 = not heated"),

      cooling.boolean("fan_always", &CoolingOptions::fan_always, "run the fan on long layers too"),
      cooling.percent("fan_min", &CoolingOptions::fan_min, kPercent, "fan on long layers"),
      cooling.percent("fan_max", &CoolingOptions::fan_max, kPercent, "fan on short layers"),
      cooling.percent("fan_bridge", &CoolingOptions::fan_bridge, kPercent, "fan on bridges"),
      cooling.integer("fan_off_layers", &CoolingOptions::fan_off_layers, "layers", kLayers,
                      "first ones without fan"),
      cooling.integer("fan_full_layer", &CoolingOptions::fan_full_layer, "", kLayers,
                      "layer at which the fan has its full speed"),
      cooling.number("fan_below_time", &CoolingOptions::fan_below_time, "s", within(0.0, 10000.0),
                     "shorter layers get more fan"),
      cooling.number("slow_below_time", &CoolingOptions::slow_below_time, "s", within(0.0, 10000.0),
                     "shorter layers are slowed down; 0 = never"),
      cooling.number("min_speed", &CoolingOptions::min_speed, "mm/s", above(0.0, 2000.0),
                     "slowing down stops here"),
  };
}

std::vector<Key> axis_keys(const std::string& name, AxisValues MachineLimits::*member,
                           const std::string& unit, const std::string& meaning) {
  const KeyGroup<AxisValues> axes{"limits." + name,
                                  [member](Settings& s) -> AxisValues& { return s.gcode.limits.*member; }};
  return {axes.number("x", &AxisValues::x, unit, above(0.0, 1e6), meaning),
          axes.number("y", &AxisValues::y, unit, above(0.0, 1e6), meaning),
          axes.number("z", &AxisValues::z, unit, above(0.0, 1e6), meaning),
          axes.number("e", &AxisValues::e, unit, above(0.0, 1e6), meaning)};
}

std::vector<Key> printer_keys() {
  const KeyGroup<MarlinOptions> printer{"printer",
                                        [](Settings& s) -> MarlinOptions& { return s.gcode.marlin; }};
  const KeyGroup<PrintVolume> volume{"printer", [](Settings& s) -> PrintVolume& { return s.gcode.volume; }};
  const KeyGroup<MachineLimits> limits{"limits",
                                       [](Settings& s) -> MachineLimits& { return s.gcode.limits; }};
  const KeyGroup<PortOptions> connection{"connection", [](Settings& s) -> PortOptions& { return s.port; }};
  return {
      printer.text("model", &MarlinOptions::printer_model, "name of the machine"),
      printer.text("vendor", &MarlinOptions::printer_vendor, "who made it"),
      printer.number("nozzle_diameter", &MarlinOptions::nozzle_diameter, "mm", within(0.05, 5.0),
                     "of the nozzle"),
      volume.choice("bed_shape", &PrintVolume::shape, {"rectangle", "circle"}, "printable area"),
      volume.choice("origin", &PrintVolume::origin, {"corner", "center"}, "where x = y = 0 lies on the bed"),
      volume.number("width", &PrintVolume::width, "mm", above(0.0, 10000.0),
                    "printable along x; diameter of a circle"),
      volume.number("depth", &PrintVolume::depth, "mm", above(0.0, 10000.0), "printable along y"),
      volume.number("height", &PrintVolume::height, "mm", above(0.0, 10000.0), "printable along z"),

      limits.number("print_acceleration", &MachineLimits::print_acceleration, "mm/s^2", above(0.0, 100000.0),
                    "of extruding moves"),
      limits.number("retract_acceleration", &MachineLimits::retract_acceleration, "mm/s^2",
                    above(0.0, 100000.0), "of the extruder alone"),
      limits.number("travel_acceleration", &MachineLimits::travel_acceleration, "mm/s^2",
                    above(0.0, 100000.0), "of travel"),
      limits.number("min_print_feedrate", &MachineLimits::min_print_feedrate, "mm/s", within(0.0, 1000.0),
                    "slowest extruding move"),
      limits.number("min_travel_feedrate", &MachineLimits::min_travel_feedrate, "mm/s", within(0.0, 1000.0),
                    "slowest travel"),

      connection.integer("baud", &PortOptions::baud, "bit/s", within(1200, 4000000),
                         "speed of a serial line"),
      connection.choice("restart", &PortOptions::restart, {"as_wired", "force", "avoid"},
                        "of the board when its port is opened"),
  };
}

std::vector<Key> gcode_keys() {
  const KeyGroup<TemplateOptions> gcode{
      "gcode", [](Settings& s) -> TemplateOptions& { return s.gcode.marlin.templates; }};
  const KeyGroup<FirmwareFeatures> features{
      "features", [](Settings& s) -> FirmwareFeatures& { return s.gcode.marlin.features; }};
  const KeyGroup<MarlinOptions> output{"output",
                                       [](Settings& s) -> MarlinOptions& { return s.gcode.marlin; }};
  const KeyGroup<PlanOptions> plan{"output", [](Settings& s) -> PlanOptions& { return s.gcode.plan; }};
  return {
      gcode.gcode("start", &TemplateOptions::start, "before the first layer"),
      gcode.gcode("end", &TemplateOptions::end, "after the last layer"),
      gcode.gcode("before_layer", &TemplateOptions::before_layer, "at each layer change, before the move up"),
      gcode.gcode("after_layer", &TemplateOptions::after_layer, "at each layer change, after the move up"),
      gcode.gcode("filament_start", &TemplateOptions::filament_start,
                  "the filament's, after the printer's start"),
      gcode.gcode("filament_end", &TemplateOptions::filament_end, "the filament's, before the printer's end"),

      features.boolean("m73", &FirmwareFeatures::m73, "the firmware shows M73 progress"),
      features.boolean("accelerations", &FirmwareFeatures::accelerations,
                       "M204 where the acceleration changes"),

      output.boolean("label_objects", &MarlinOptions::label_objects,
                     "comments that let a host cancel an object"),
      output.integer("xyz_decimals", &MarlinOptions::xyz_decimals, "", within(1, 6), "decimals of positions"),
      output.integer("e_decimals", &MarlinOptions::e_decimals, "", within(1, 7),
                     "decimals of filament lengths"),
      output.number("max_extrusion", &MarlinOptions::max_extrusion, "mm", above(0.0, 10000.0),
                    "longest E word of one line"),
      plan.number("resolution", &PlanOptions::resolution, "mm", within(0.0, 1.0),
                  "points closer to the line without them are left out"),
  };
}

std::vector<Key> all_keys() {
  std::vector<Key> table;
  const auto append = [&](std::vector<Key> keys) {
    table.insert(table.end(), std::make_move_iterator(keys.begin()), std::make_move_iterator(keys.end()));
  };
  append(slicing_keys());
  append(path_keys());
  append(motion_keys());
  append(filament_keys());
  append(printer_keys());
  append(axis_keys("max_feedrate", &MachineLimits::max_feedrate, "mm/s", "fastest of the axis"));
  append(axis_keys("max_acceleration", &MachineLimits::max_acceleration, "mm/s^2", "highest of the axis"));
  append(
      axis_keys("max_jerk", &MachineLimits::max_jerk, "mm/s", "largest sudden change of speed of the axis"));
  append(gcode_keys());
  return table;
}

}  // namespace

const std::vector<Key>& key_table() {
  static const std::vector<Key> table = all_keys();
  return table;
}

const Key& find_key(std::string_view name, const Origin& origin) {
  const std::vector<Key>& table = key_table();
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Key& key) { return key.name == name; });
  if (found != table.end()) return *found;

  std::vector<std::string> names;
  names.reserve(table.size());
  for (const Key& key : table) names.push_back(key.name);
  ProfileError::Fields fields;
  fields.origin = origin;
  fields.key = name;
  fields.problem = "unknown key '" + fields.key + "'";
  fields.hint = suggestion(name, names, "'lamina profiles show' lists the keys");
  throw ProfileError(std::move(fields));
}

}  // namespace lamina::profiles
