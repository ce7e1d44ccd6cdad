#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "engine/import/read_model.h"
#include "engine/model_bounds.h"
#include "engine/slicer.h"
#include "tools/cli/contours_csv.h"
#include "tools/cli/contours_json.h"
#include "tools/cli/failure.h"
#include "tools/cli/model_input.h"
#include "tools/cli/output_file.h"
#include "tools/cli/pipeline.h"
#include "tools/cli/profile_arguments.h"
#include "tools/cli/progress_bar.h"
#include "tools/cli/verbs.h"
#include "tools/preview/layer_svg.h"

namespace lamina::tools {
namespace {

constexpr double kFrameMargin = 1.0;  // mm around the model in a picture
constexpr double kMeasureTolerance =
    0.1;  // of the slicing tolerance: area and length add nothing to its error

struct ContoursArguments {
  std::string model;
  SlicingArguments slicing;
  std::vector<double> heights;
  double scale = 1.0;
  std::string csv;
  double step = 0.05;
  std::string svg_folder;
  bool json = false;
  bool force = false;
  bool quiet = false;
};

void declare(OptionSet& options, ContoursArguments& arguments) {
  options.argument("MODEL", arguments.model, kModelFiles);
  arguments.slicing.declare(options);
  options.numbers("--at", arguments.heights, "Z,Z,...", "Slice at these heights only, mm");
  options.number("--scale", arguments.scale, "FACTOR", "Scale the model about its origin");
  options.text("--csv", arguments.csv, "FILE", "Points along every contour, - for stdout");
  options.number("--step", arguments.step, "MM", "Distance of the points [0.05]");
  options.text("--svg", arguments.svg_folder, "FOLDER", "One picture per layer");
  options.flag("--json", arguments.json, "Print each layer's figures as JSON");
  options.flag("--force", arguments.force, "Overwrite files that exist");
  options.flag("--quiet", arguments.quiet, "No progress");
}

void check(const ContoursArguments& arguments) {
  if (arguments.json && arguments.csv == "-") {
    throw Failure(ExitCode::kUsage, "--json and --csv - both write to stdout", "give --csv a file");
  }
  if (!(arguments.step > 0.0)) throw Failure(ExitCode::kUsage, "--step must be a number above 0 mm");
  if (!(arguments.scale > 0.0)) throw Failure(ExitCode::kUsage, "--scale must be a number above 0");
}

/// Planes through single heights; they stand for no layer, so they have no thickness.
std::vector<engine::SlicePlane> planes_at(std::vector<double> heights) {
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  std::vector<engine::SlicePlane> planes;
  planes.reserve(heights.size());
  for (const double z : heights) planes.push_back({z, z, z});
  return planes;
}

/// Where the layers go: files, stdout, or a table on stdout when nothing else was asked for.
class ContoursOutput {
 public:
  ContoursOutput(const ContoursArguments& arguments, const engine::Model& model, const engine::Box3& bounds,
                 double tolerance)
      : arguments_(arguments),
        overwrite_(arguments.force ? Overwrite::kAllow : Overwrite::kRefuse),
        measure_tolerance_(kMeasureTolerance * tolerance),
        csv_(arguments.step),
        table_(!arguments.json && arguments.csv.empty() && arguments.svg_folder.empty()) {
    if (!arguments.csv.empty()) {
      csv_file_.emplace(arguments.csv, overwrite_);
      csv_file_->write(ContoursCsv::header());
    }
    if (!arguments.svg_folder.empty()) {
      std::error_code error;
      std::filesystem::create_directories(arguments.svg_folder, error);
      if (error) {
        throw Failure(ExitCode::kUsage,
                      "cannot make the folder " + arguments.svg_folder + ": " + error.message());
      }
      const engine::Vector2 margin = engine::Vector2::Constant(kFrameMargin);
      frame_ = {bounds.min().head<2>() - margin, bounds.max().head<2>() + margin};
    }
    if (arguments.json) std::cout << ContoursJson::begin(model, tolerance);
    if (table_) {
      std::cout << fmt::format("{:>6} {:>10} {:>12} {:>11} {:>6} {:>5} {:>6} {:>6}\n", "layer", "z", "area",
                               "length", "closed", "open", "planar", "points");
    }
  }

  void add(const engine::Layer& layer) {
    if (csv_file_) csv_file_->write(csv_.rows(layer));
    if (!arguments_.svg_folder.empty()) {
      const std::string name = fmt::format("layer_{:05}.svg", layer.index);
      OutputFile picture((std::filesystem::path(arguments_.svg_folder) / name).string(), overwrite_);
      picture.write(layer_svg(layer, frame_));
      picture.finish();
    }
    const LayerFigures figures = measure(layer, measure_tolerance_);
    contours_ += figures.contours();
    ++layers_;
    if (arguments_.json) std::cout << json_.layer(figures);
    if (table_) {
      std::cout << fmt::format("{:6} {:10.4f} {:12.4f} {:11.4f} {:6} {:5} {:6} {:6}\n", figures.index,
                               figures.z, figures.area, figures.length, figures.closed, figures.open,
                               figures.planar_outer, figures.points);
    }
  }

  void finish() {
    if (csv_file_) csv_file_->finish();
    if (arguments_.json) std::cout << ContoursJson::end();
    if (arguments_.json || table_ || arguments_.csv == "-") return;
    std::cout << fmt::format("{} layers, {} contours\n", layers_, contours_);
    if (csv_file_) std::cout << arguments_.csv << '\n';
    if (!arguments_.svg_folder.empty()) std::cout << arguments_.svg_folder << '\n';
  }

 private:
  const ContoursArguments& arguments_;
  Overwrite overwrite_;
  double measure_tolerance_;
  ContoursCsv csv_;
  ContoursJson json_;
  bool table_;
  std::optional<OutputFile> csv_file_;
  engine::Box2 frame_;
  std::size_t layers_ = 0;
  std::size_t contours_ = 0;
};

ExitCode run(const ContoursArguments& arguments) {
  check(arguments);
  profiles::Settings settings = resolve({}, arguments.slicing).settings;
  // A thicker first layer is the printer's business.
  settings.planes.first_layer_thickness = 0.0;
  ProgressBar bar(arguments.quiet);
  bar.begin("Reading " + arguments.model);
  const engine::ImportResult import = engine::read_model(arguments.model);
  bar.clear();
  say_warnings(import_warnings(import.report));

  const engine::Model model =
      arguments.scale == 1.0
          ? import.model
          : engine::transformed(import.model, Eigen::Affine3d(Eigen::Scaling(arguments.scale)));
  const engine::Box3 bounds = engine::model_bounds(model);
  if (bounds.isEmpty())
    throw Failure(ExitCode::kGeometry, model.name + " holds nothing that could be sliced");
  const std::vector<engine::SlicePlane> planes = arguments.heights.empty()
                                                     ? plan_layers(model, bounds, settings.planes).planes
                                                     : planes_at(arguments.heights);
  for (const engine::SlicePlane& plane : planes) {
    if (plane.z >= bounds.min().z() - engine::kModelTolerance &&
        plane.z <= bounds.max().z() + engine::kModelTolerance)
      continue;
    say_warnings({fmt::format("z = {} mm misses the model, which reaches from {} to {} mm", plane.z,
                              bounds.min().z(), bounds.max().z())});
  }

  bar.begin("Slicing " + model.name);
  engine::Slicer slicer(model, planes, settings.slice);
  ContoursOutput output(arguments, model, bounds, settings.slice.epsilon);
  SlicingFlaws flaws;
  while (const std::optional<engine::Layer> layer = slicer.next()) {
    output.add(*layer);
    flaws.add(*layer);
    bar.update(static_cast<double>(layer->index + 1) / static_cast<double>(planes.size()),
               fmt::format("layer {}/{}", layer->index + 1, planes.size()));
  }
  bar.clear();
  output.finish();
  say_warnings(slicing_warnings(flaws));
  return ExitCode::kOk;
}

}  // namespace

Verb contours_verb() {
  const auto arguments = std::make_shared<ContoursArguments>();
  return {"contours", "Slice a model into contours, in its own coordinates",
          "  lamina contours part.igs\n"
          "  lamina contours part.igs --at 5.0,7.5 --csv points.csv --step 0.05\n"
          "  lamina contours part.igs --layer-height 0.1 --tolerance 0.02 --slice-at bottom --json\n"
          "  lamina contours part.igs --svg pictures",
          [arguments](OptionSet& options) { declare(options, *arguments); },
          [arguments] { return run(*arguments); }};
}

}  // namespace lamina::tools
