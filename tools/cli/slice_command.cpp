#include <chrono>
#include <iostream>
#include <memory>

#include <fmt/format.h>

#include "gcode/marlin/gcode_reader.h"
#include "tools/cli/failure.h"
#include "tools/cli/file_header.h"
#include "tools/cli/gcode_picture.h"
#include "tools/cli/json.h"
#include "tools/cli/model_input.h"
#include "tools/cli/output_file.h"
#include "tools/cli/pipeline.h"
#include "tools/cli/print_summary.h"
#include "tools/cli/profile_arguments.h"
#include "tools/cli/progress_bar.h"
#include "tools/cli/verbs.h"

namespace lamina::tools {
namespace {

constexpr std::size_t kPictures = 6;

struct SliceArguments {
  std::vector<std::string> models;
  std::string output;
  std::string picture;
  std::string report;
  ProfileArguments profile;
  SlicingArguments slicing;
  PlacementArguments placement;
  bool force = false;
  bool json = false;
  bool quiet = false;
};

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void declare(OptionSet& options, SliceArguments& arguments) {
  options.arguments("MODEL...", arguments.models, std::string(kModelFiles) + "; several go on one bed");
  options.text("-o,--output", arguments.output, "FILE",
               "G-code file, - for stdout [MODEL's name.gcode, here]");
  arguments.profile.declare(options);
  arguments.slicing.declare(options);
  arguments.placement.declare(options);
  options.text("--picture", arguments.picture, "FILE", "Also draw the toolpaths of some layers (SVG)");
  options.text("--report", arguments.report, "FILE",
               "Also write what slicing counted and how long it took (JSON)");
  options.flag("--force", arguments.force, "Overwrite files that exist");
  options.flag("--json", arguments.json, "Print the result as JSON");
  options.flag("--quiet", arguments.quiet, "No progress");
}

ExitCode run(const SliceArguments& arguments) {
  const bool to_stdout = arguments.output == "-";
  if (to_stdout && arguments.json) {
    throw Failure(ExitCode::kUsage, "--json and -o - both write to stdout", "give -o a file");
  }
  profiles::ResolvedProfile profile = resolve(arguments.profile, arguments.slicing);
  ProgressBar bar(arguments.quiet);
  if (!arguments.report.empty()) profile.settings.slice.clock = seconds_now;
  const ModelInput input = read_models(arguments.models, bar);
  say_warnings(input.warnings);

  const std::string& name = input.models.front().name;
  const std::string path = arguments.output.empty() ? name + ".gcode" : arguments.output;
  const Overwrite overwrite = arguments.force ? Overwrite::kAllow : Overwrite::kRefuse;
  name_print(profile.settings, name);
  const PlacedModel placed = place(input.models, arguments.placement, profile.settings.gcode.volume);
  say_warnings(placed.warnings);
  OutputFile output(path, overwrite);
  bar.begin("Slicing " + name);
  ModelGcode gcode(placed, profile.settings);
  gcode::GcodeReader written(profile.settings.gcode.limits);
  GcodePicture picture(arguments.picture.empty() ? 0 : gcode.layer_count(), kPictures);
  while (const auto lines = gcode.next()) {
    for (const std::string& line : *lines) {
      output.write_line(line);
      if (arguments.json) written.read(line);
      if (!arguments.picture.empty()) picture.read(line);
    }
    bar.update(static_cast<double>(gcode.layers_sliced()) / static_cast<double>(gcode.layer_count()),
               fmt::format("layer {}/{}", gcode.layers_sliced(), gcode.layer_count()));
  }
  bar.clear();
  output.finish();
  if (!arguments.picture.empty()) {
    OutputFile file(arguments.picture, overwrite);
    file.write(picture.svg());
    file.finish();
  }

  if (!arguments.report.empty()) {
    SliceReport report = gcode.report();
    report.peak_megabytes = peak_megabytes_so_far();
    OutputFile file(arguments.report, overwrite);
    file.write(to_text(to_json(report)) + "\n");
    file.finish();
  }

  const std::vector<std::string> warnings = print_warnings(gcode.flaws(), gcode.totals());
  say_warnings(warnings);
  if (arguments.json) {
    Json json{{"output", path}};
    json.update(print_summary_json(gcode.totals(), profile));
    json["nozzle_box_mm"] = to_json(written.summary().extrusion_bounds);  // prime line included
    json["warnings"] = input.warnings;
    for (const auto* more : {&placed.warnings, &warnings}) {
      for (const std::string& warning : *more) json["warnings"].push_back(warning);
    }
    std::cout << to_text(json) << '\n';
  } else {
    std::ostream& stream = to_stdout ? std::cerr : std::cout;
    if (!to_stdout) stream << path << '\n';
    if (!to_stdout || !arguments.quiet)
      stream << print_summary(gcode.totals(), profile.settings.gcode.filament);
  }
  return ExitCode::kOk;
}

}  // namespace

Verb slice_verb() {
  const auto arguments = std::make_shared<SliceArguments>();
  return {"slice", "Slice a model into a G-code file",
          "  lamina slice part.igs\n"
          "  lamina slice part.igs -p prusa_mk3s -f petg -q fine -o part.gcode\n"
          "  lamina slice part.igs --layer-height 0.15 -s infill.density=30 -s wall.loops=4\n"
          "  lamina slice lid.stl box.step --copies 2 --rotate 90\n"
          "  lamina slice inch_part.igs --scale 0.5 -o - | gzip > part.gcode.gz",
          [arguments](OptionSet& options) { declare(options, *arguments); },
          [arguments] { return run(*arguments); }};
}

}  // namespace lamina::tools
