#include "tools/cli/emulated_printer.h"

#include <array>

#include <fmt/format.h>

#include "gcode/marlin/time_text.h"
#include "tools/cli/failure.h"

namespace lamina::tools {
namespace {

transport::PerAxis per_axis(const gcode::AxisValues& values) {
  return {values.x, values.y, values.z, values.e};
}

struct FeatureName {
  const char* name;
  bool transport::FirmwareFeatures::*feature;
};

constexpr std::array kFeatures{
    FeatureName{"advanced-ok", &transport::FirmwareFeatures::advanced_ok},
    FeatureName{"emergency-parser", &transport::FirmwareFeatures::emergency_parser},
    FeatureName{"host-actions", &transport::FirmwareFeatures::host_actions},
    FeatureName{"arcs", &transport::FirmwareFeatures::arcs},
    FeatureName{"bezier", &transport::FirmwareFeatures::bezier},
    FeatureName{"auto-report", &transport::FirmwareFeatures::auto_report},
    FeatureName{"silent-duplicates", &transport::FirmwareFeatures::silent_duplicates},
    FeatureName{"meatpack", &transport::FirmwareFeatures::meatpack},
    FeatureName{"sd-card", &transport::FirmwareFeatures::sd_card},
    FeatureName{"retraction", &transport::FirmwareFeatures::firmware_retraction},
    FeatureName{"leveling", &transport::FirmwareFeatures::leveling},
    FeatureName{"filament-change", &transport::FirmwareFeatures::filament_change},
    FeatureName{"cancel-objects", &transport::FirmwareFeatures::cancel_objects}};

}  // namespace

void switch_feature(transport::FirmwareFeatures& features, const std::string& name) {
  const bool off = name.starts_with("no-");
  const std::string wanted = off ? name.substr(3) : name;
  for (const FeatureName& known : kFeatures) {
    if (wanted != known.name) continue;
    features.*known.feature = !off;
    return;
  }
  throw Failure(ExitCode::kUsage,
                fmt::format("there is no firmware feature '{}'; known: {}", name, firmware_feature_names()));
}

std::string firmware_feature_names() {
  std::string names;
  for (const FeatureName& known : kFeatures) names += (names.empty() ? "" : ", ") + std::string(known.name);
  return names;
}

transport::EmulatorOptions emulated_printer(const profiles::Settings& settings) {
  transport::EmulatorOptions options;
  options.machine_name = "emulated " + settings.gcode.marlin.printer_model;
  const engine::Box3 bed = settings.gcode.volume.bounds();
  const gcode::MachineLimits& limits = settings.gcode.limits;
  transport::MotionOptions& motion = options.motion;
  motion.bed_min = {bed.min().x(), bed.min().y(), bed.min().z()};
  motion.bed_max = {bed.max().x(), bed.max().y(), bed.max().z()};
  motion.max_feedrate = per_axis(limits.max_feedrate);
  motion.max_acceleration = per_axis(limits.max_acceleration);
  motion.acceleration = limits.print_acceleration;
  motion.travel_acceleration = limits.travel_acceleration;
  motion.retract_acceleration = limits.retract_acceleration;
  motion.filament_diameter = settings.gcode.filament.diameter;
  motion.max_extrude_length = settings.gcode.marlin.max_extrusion;
  return options;
}

std::string report_text(const transport::PrintReport& report) {
  std::string text = fmt::format("  printed   {} beads on {} layers in {}\n", report.beads, report.layers,
                                 gcode::duration_text(transport::to_seconds(report.moving)));
  text += fmt::format("  deposited {:.2f} mm^3 ({:.2f} mm of filament)\n", report.volume, report.filament);
  if (report.beads > 0) {
    text += fmt::format("  box       ({:.2f}, {:.2f}, {:.2f}) to ({:.2f}, {:.2f}, {:.2f}) mm\n",
                        report.box_min[0], report.box_min[1], report.box_min[2], report.box_max[0],
                        report.box_max[1], report.box_max[2]);
  }
  const auto fault = [&](std::int64_t count, const char* what) {
    if (count > 0) text += fmt::format("  fault     {} {}\n", count, what);
  };
  if (report.underruns > 0) {
    text += fmt::format("  ran dry   {} times while extruding, {:.2f} s in all: the lines came too slowly\n",
                        report.underruns, transport::to_seconds(report.starved));
  }
  fault(report.cold_extrusions, "moves wanted to extrude with a cold nozzle");
  fault(report.too_long_extrusions, "moves extruded more than the firmware allows");
  fault(report.outside_moves, "moves led outside the bed");
  fault(report.unknown_commands, "commands that the firmware does not know");
  fault(report.refused_lines, "lines were refused and asked for again");
  fault(report.duplicate_lines, "lines came twice");
  fault(report.bytes_lost, "bytes found the receive buffer full");
  fault(report.doubled_lines, "numbered lines were run twice");
  fault(report.skipped_lines, "numbered lines were never run");
  fault(report.unnumbered_commands, "commands without a number were run in a numbered print");
  if (report.longest_ooze > std::chrono::seconds(1)) {
    text += fmt::format("  oozed     for {:.1f} s at most, standing still with a hot nozzle under pressure\n",
                        transport::to_seconds(report.longest_ooze));
  }
  return text;
}

Json to_json(const transport::PrintReport& report) {
  return {{"deposited_mm3", report.volume},
          {"filament_mm", report.filament},
          {"beads", report.beads},
          {"moves", report.moves},
          {"layers", report.layers},
          {"box_min_mm", report.box_min},
          {"box_max_mm", report.box_max},
          {"moving_seconds", transport::to_seconds(report.moving)},
          {"underruns", report.underruns},
          {"starved_seconds", transport::to_seconds(report.starved)},
          {"cold_extrusions", report.cold_extrusions},
          {"too_long_extrusions", report.too_long_extrusions},
          {"outside_moves", report.outside_moves},
          {"lines_run", report.lines_run},
          {"unknown_commands", report.unknown_commands},
          {"refused_lines", report.refused_lines},
          {"duplicate_lines", report.duplicate_lines},
          {"bytes_lost", report.bytes_lost},
          {"doubled_lines", report.doubled_lines},
          {"skipped_lines", report.skipped_lines},
          {"unnumbered_commands", report.unnumbered_commands},
          {"unnumbered_moves", report.unnumbered_moves},
          {"longest_ooze_seconds", transport::to_seconds(report.longest_ooze)}};
}

}  // namespace lamina::tools
