// How time and memory grow: with 1 / epsilon, with the number of layers at the same model, with the height
// of the model. Fails where the exponent in 1 / epsilon is above 1.1, or memory follows the layers.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "engine/import/read_model.h"
#include "engine/model_bounds.h"
#include "tools/bench/corpus_models.h"
#include "tools/bench/measurement.h"
#include "tools/bench/slice_run.h"

namespace {

using namespace lamina;

constexpr double kMostExponent = 1.1;
/// Of memory in the number of layers; an allocator's rounding is more than nothing.
constexpr double kMostLayerExponent = 0.02;

struct Arguments {
  std::filesystem::path file;
  std::vector<double> epsilons{0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};
  std::vector<double> heights{1, 2, 4, 8, 16};
  double lambda = 0.2;
  int repeats = 3;
};

tools::SliceRun measure(const Arguments& arguments, double lambda, double epsilon, double height,
                        bool stack) {
  tools::SliceRun best;
  for (int k = 0; k < arguments.repeats; ++k) {
    const tools::SliceRun run = tools::measured_apart([&] {
      const engine::Model single = engine::read_model(arguments.file).model;
      engine::Model model;
      if (stack) {
        const double step = 1.05 * engine::model_bounds(single).sizes().z();
        for (double copy = 0.0; copy < height; ++copy) {
          const Eigen::Affine3d up(Eigen::Translation3d(0.0, 0.0, copy * step));
          for (const engine::Surface& surface : engine::transformed(single, up).surfaces)
            model.surfaces.push_back(surface);
        }
      } else {
        Eigen::Affine3d stretch = Eigen::Affine3d::Identity();
        stretch.linear()(2, 2) = height;
        model = engine::transformed(single, stretch);
      }
      engine::SliceOptions options;
      options.epsilon = epsilon;
      return tools::slice_once(model, tools::dissertation_planes(model, lambda), options);
    });
    if (k == 0 || run.cpu_seconds < best.cpu_seconds) best = run;
  }
  return best;
}

void print(const char* what, double value, const tools::SliceRun& run) {
  fmt::print("{:<12} {:>8} {:>8} {:>10.4f} {:>10.1f} {:>12.0f} {:>10.0f}\n", what, value, run.layers,
             run.cpu_seconds, run.peak_megabytes, run.length, run.control_points);
  std::fflush(stdout);
}

/// Exponents of time and memory over a series.
struct Growth {
  double time = 0.0;
  double memory = 0.0;
};

template <typename Measure>
Growth series(const char* what, const std::vector<double>& values, bool inverse, Measure measured) {
  std::vector<double> sizes;
  std::vector<double> seconds;
  std::vector<double> megabytes;
  for (const double value : values) {
    const tools::SliceRun run = measured(value);
    print(what, value, run);
    sizes.push_back(inverse ? 1.0 / value : value);
    seconds.push_back(run.cpu_seconds);
    megabytes.push_back(run.peak_megabytes);
  }
  const Growth growth{tools::fitted_exponent(sizes, seconds), tools::fitted_exponent(sizes, megabytes)};
  fmt::print("  exponent of time {:.3f}, of memory {:.3f}\n", growth.time, growth.memory);
  return growth;
}

int run(int argc, char** argv) {
  constexpr int kSkipped = 77;
  Arguments arguments;
  std::string corpus = LAMINA_CORPUS_DIR;
  std::vector<std::string> models{"seed/vertebra504", "seed/trefoil", "seed/torus"};
  bool quick = false;
  CLI::App app("Growth of time and memory with 1 / epsilon, with the number of layers and with the height");
  app.add_option("--corpus", corpus, "Folder with the model corpus");
  app.add_option("--model", models, "Part of a file's name; repeat for several");
  app.add_option("--lambda", arguments.lambda, "Layer thickness, mm");
  app.add_option("--epsilon", arguments.epsilons, "Tolerances, mm")->delimiter(',');
  app.add_option("--repeats", arguments.repeats, "Runs, of which the fastest counts");
  app.add_flag("--quick", quick, "The trefoil, few values");
  CLI11_PARSE(app, argc, argv);
  if (quick) {
    models = {"seed/trefoil"};
    arguments.epsilons = {0.1, 0.01, 0.001};
    arguments.heights = {1, 4};
    arguments.lambda = 1.0;
    arguments.repeats = 1;
  }
  const auto files = tools::corpus_models(corpus, models);
  if (files.empty()) {
    fmt::print(stderr, "{}: the corpus is needed for this measurement\n", corpus);
    return kSkipped;
  }
  bool holds = true;
  for (const tools::CorpusModel& model : files) {
    arguments.file = model.file;
    fmt::print("\n{}\n{:<12} {:>8} {:>8} {:>10} {:>10} {:>12} {:>10}\n", model.name, "", "", "layers",
               "CPU s", "peak MB", "length mm", "controls");
    const Growth fine = series("epsilon", arguments.epsilons, true, [&](double epsilon) {
      return measure(arguments, arguments.lambda, epsilon, 1.0, false);
    });
    const double epsilon = 0.02;
    // The same model, more layers: stretched upwards.
    const Growth tall = series("stretched", arguments.heights, false, [&](double height) {
      return measure(arguments, arguments.lambda, epsilon, height, false);
    });
    // A larger model: copies on top of each other. Memory follows the file, not the layers.
    series("stacked", arguments.heights, false,
           [&](double height) { return measure(arguments, arguments.lambda, epsilon, height, true); });
    const bool fine_holds = fine.time <= kMostExponent && fine.memory <= kMostExponent;
    const bool tall_holds = tall.memory <= kMostLayerExponent;
    if (!fine_holds) fmt::print("FAILS: an exponent in 1 / epsilon is above {}\n", kMostExponent);
    if (!tall_holds) fmt::print("FAILS: memory grows with the number of layers\n");
    holds = holds && fine_holds && tall_holds;
  }
  return holds ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return lamina::tools::run_measurement(run, argc, argv);
}
