#include "tools/cli/emulated_printer.h"

#include <fmt/format.h>

#include "gcode/marlin/time_text.h"

namespace lamina::tools {
namespace {

transport::PerAxis per_axis(const gcode::AxisValues& values) {
  return {values.x, values.y, values.z, values.e};
}

}  // namespace

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
          {"bytes_lost", report.bytes_lost}};
}

}  // namespace lamina::tools
