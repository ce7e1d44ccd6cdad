// The accuracy test of the dissertation's chapter seven (p. 163 to 172): every contour is sampled at a
// thousandth of its length, each sample is projected onto the model's surfaces, and the distances are
// averaged over all layers.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "engine/import/read_model.h"
#include "engine/slicer.h"
#include "engine/slicing_planes.h"
#include "tests/reference/pointcloud/decompose.h"
#include "tools/bench/dissertation_models.h"
#include "tools/bench/surface_distance.h"

namespace {

using namespace lamina;

constexpr int kBandConstant = 3;
constexpr double kSamplesPerLength = 0.001;

struct CellResult {
  double distance_sum = 0.0;
  double greatest = 0.0;
  std::size_t points = 0;
  std::size_t layers = 0;
  double slicing_seconds = 0.0;

  double average() const { return points == 0 ? 0.0 : distance_sum / static_cast<double>(points); }
};

std::vector<const engine::PieceCurve*> curves_of(const engine::Layer& layer) {
  std::vector<const engine::PieceCurve*> curves;
  for (const engine::ClosedContour& contour : layer.closed) curves.push_back(&contour.curve);
  for (const engine::OpenContour& contour : layer.open) curves.push_back(&contour.curve);
  for (const engine::PlanarContour& contour : layer.planar) {
    curves.push_back(&contour.outer);
    for (const engine::PieceCurve& inner : contour.inner) curves.push_back(&inner);
  }
  return curves;
}

void measure(const engine::Layer& layer, const tools::SurfaceDistance& surfaces, CellResult& result) {
  for (const engine::PieceCurve* curve : curves_of(layer)) {
    const double step = kSamplesPerLength * engine::length(*curve);
    for (const engine::Vector2& point : engine::sample_evenly(*curve, step)) {
      const double distance = surfaces.distance({point.x(), point.y(), layer.plane.z});
      result.distance_sum += distance;
      result.greatest = std::max(result.greatest, distance);
      ++result.points;
    }
  }
}

CellResult run_cell(const engine::Model& model, double lambda, double epsilon) {
  using Clock = std::chrono::steady_clock;
  const engine::Box3 bounds = engine::model_bounds(model);
  engine::SliceOptions options;
  options.epsilon = epsilon;
  const auto planes = engine::make_slicing_planes(bounds.min().z(), bounds.max().z(),
                                                  {lambda, 0.0, engine::SlicePosition::kBottom});
  tools::SurfaceDistance surfaces(reference::decompose(model, {lambda, kBandConstant}));
  CellResult result;
  auto started = Clock::now();
  engine::Slicer slicer(model, planes, options);
  while (const auto layer = slicer.next()) {
    result.slicing_seconds += std::chrono::duration<double>(Clock::now() - started).count();
    surfaces.select_plane(layer->plane.z, 2.0 * epsilon);
    measure(*layer, surfaces, result);
    ++result.layers;
    started = Clock::now();
  }
  return result;
}

struct Arguments {
  std::string corpus = LAMINA_CORPUS_DIR;
  std::vector<std::string> models;  ///< part of a model's name; empty: all six
  std::vector<double> lambdas{0.5, 0.1, 0.05};
  std::vector<double> epsilons{0.1, 0.05, 0.01};
  double most_average = 0.0;  ///< in epsilon; 0: report only
};

bool wanted(const Arguments& arguments, const tools::DissertationModel& model) {
  return arguments.models.empty() ||
         std::any_of(arguments.models.begin(), arguments.models.end(),
                     [&](const std::string& part) { return model.name.find(part) != std::string::npos; });
}

/// One table in the form of tables 7.1 to 7.6, with the greatest distance and the time for slicing beside it.
/// Returns whether every average is within the limit.
bool print_table(const tools::DissertationModel& entry, const engine::Model& model,
                 const Arguments& arguments) {
  bool within = true;
  fmt::print("Table {} - {} ({}) model test results\n", entry.table, entry.name, entry.corpus_file);
  fmt::print("{:<8} {:<8} {:>18} {:>14} {:>12} {:>14} {:>8} {:>12}\n", "lambda", "epsilon",
             "Average Distance", "Points Tested", "average/eps", "Max Distance", "Layers", "Slicing s");
  for (const double lambda : arguments.lambdas) {
    for (const double epsilon : arguments.epsilons) {
      const CellResult cell = run_cell(model, lambda, epsilon);
      fmt::print("{:<8} {:<8} {:>18.4f} {:>14} {:>12.3f} {:>14.4f} {:>8} {:>12.2f}\n", lambda, epsilon,
                 cell.average(), cell.points, cell.average() / epsilon, cell.greatest, cell.layers,
                 cell.slicing_seconds);
      std::fflush(stdout);
      if (cell.points == 0) within = false;
      if (arguments.most_average > 0.0 && cell.average() > arguments.most_average * epsilon) within = false;
    }
  }
  fmt::print("\n");
  return within;
}

int run(int argc, char** argv) {
  constexpr int kSkipped = 77;
  Arguments arguments;
  bool quick = false;
  CLI::App app("Average distance from contours to surfaces, as in the dissertation's tables 7.1 to 7.6");
  app.add_option("--corpus", arguments.corpus, "Folder with the model corpus");
  app.add_option("--model", arguments.models, "Part of a model's name, such as Torus; repeat for several");
  app.add_option("--lambda", arguments.lambdas, "Layer thicknesses, mm")->delimiter(',');
  app.add_option("--epsilon", arguments.epsilons, "Tolerances, mm")->delimiter(',');
  app.add_option("--most-average", arguments.most_average, "Fail when an average exceeds this many epsilon");
  app.add_flag("--quick", quick, "Two cells only: the vertebra at lambda 0.5, epsilon 0.1 and 0.05");
  CLI11_PARSE(app, argc, argv);
  if (quick) {
    arguments.models = {"Vertebra"};
    arguments.lambdas = {0.5};
    arguments.epsilons = {0.1, 0.05};
  }

  bool within = true;
  for (const tools::DissertationModel& entry : tools::dissertation_models()) {
    if (!wanted(arguments, entry)) continue;
    const std::filesystem::path file = std::filesystem::path(arguments.corpus) / entry.corpus_file;
    if (!std::filesystem::exists(file)) {
      fmt::print(stderr, "{}: not there; the corpus is needed for this test\n", file.string());
      return kSkipped;
    }
    within = print_table(entry, engine::read_model(file).model, arguments) && within;
  }
  return within ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
}
