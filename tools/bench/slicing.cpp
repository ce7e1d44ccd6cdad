// lamina's engine against the dissertation's dense method on equivalents of its six models: time of both in
// the same run, ratio, peak memory of each in a process of its own.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "engine/import/read_model.h"
#include "tools/bench/corpus_models.h"
#include "tools/bench/dissertation_models.h"
#include "tools/bench/measurement.h"
#include "tools/bench/slice_run.h"

namespace {

using namespace lamina;

struct Arguments {
  std::string corpus = LAMINA_CORPUS_DIR;
  std::vector<std::string> models;
  double lambda = 0.1;
  double epsilon = 0.01;
  int repeats = 3;
  bool fast_only = false;
};

/// The fastest of several runs: what else the machine does only adds.
tools::SliceRun best_of(int repeats, const std::function<tools::SliceRun()>& run) {
  tools::SliceRun best = tools::measured_apart(run);
  for (int k = 1; k < repeats; ++k) {
    const tools::SliceRun again = tools::measured_apart(run);
    if (again.cpu_seconds < best.cpu_seconds) best = again;
  }
  return best;
}

/// Returns whether both made the same number of layers.
bool compare(const tools::DissertationModel& entry, const Arguments& arguments) {
  const std::filesystem::path file = std::filesystem::path(arguments.corpus) / entry.corpus_file;
  const auto fast = best_of(arguments.repeats, [&] {
    const engine::Model model = engine::read_model(file).model;
    engine::SliceOptions options;
    options.epsilon = arguments.epsilon;
    return tools::slice_once(model, tools::dissertation_planes(model, arguments.lambda), options);
  });
  fmt::print("{:<26} {:>7} {:>10.4f} {:>9.1f} {:>11.0f} {:>9.0f}", entry.name, fast.layers, fast.cpu_seconds,
             fast.peak_megabytes, fast.length, fast.control_points);
  std::fflush(stdout);
  bool same = true;
  if (!arguments.fast_only) {
    const auto dense = tools::measured_apart([&] {
      const engine::Model model = engine::read_model(file).model;
      return tools::slice_densely_once(model, tools::dissertation_planes(model, arguments.lambda),
                                       arguments.lambda, arguments.epsilon);
    });
    fmt::print(" {:>10.3f} {:>9.1f} {:>11.0f} {:>9.0f} {:>8.1f}", dense.cpu_seconds, dense.peak_megabytes,
               dense.length, dense.control_points, dense.cpu_seconds / fast.cpu_seconds);
    same = dense.layers == fast.layers;
  }
  fmt::print("\n");
  std::fflush(stdout);
  return same;
}

int run(int argc, char** argv) {
  constexpr int kSkipped = 77;
  Arguments arguments;
  bool quick = false;
  CLI::App app("Time and memory of lamina's engine and of the dense method");
  app.add_option("--corpus", arguments.corpus, "Folder with the model corpus");
  app.add_option("--model", arguments.models, "Part of a model's name, such as Torus; repeat for several");
  app.add_option("--lambda", arguments.lambda, "Layer thickness, mm");
  app.add_option("--epsilon", arguments.epsilon, "Tolerance, mm");
  app.add_option("--repeats", arguments.repeats, "Runs of the engine, of which the fastest counts");
  app.add_flag("--fast-only", arguments.fast_only, "Leave the dense method out");
  app.add_flag("--quick", quick, "The torus at lambda 0.5, epsilon 0.05");
  CLI11_PARSE(app, argc, argv);
  if (quick) {
    arguments.models = {"Torus"};
    arguments.lambda = 0.5;
    arguments.epsilon = 0.05;
  }
  fmt::print("lambda {} mm, epsilon {} mm\n", arguments.lambda, arguments.epsilon);
  fmt::print("{:<26} {:>7} {:>10} {:>9} {:>11} {:>9} {:>10} {:>9} {:>11} {:>9} {:>8}\n", "", "layers",
             "lamina CPU", "peak MB", "length mm", "controls", "dense CPU", "peak MB", "length mm",
             "controls", "ratio");
  bool same = true;
  for (const tools::DissertationModel& entry : tools::dissertation_models()) {
    const bool wanted =
        arguments.models.empty() ||
        std::any_of(arguments.models.begin(), arguments.models.end(),
                    [&](const std::string& part) { return entry.name.find(part) != std::string::npos; });
    if (!wanted) continue;
    if (!std::filesystem::exists(std::filesystem::path(arguments.corpus) / entry.corpus_file)) {
      fmt::print(stderr, "{}: the corpus is needed for this measurement\n", arguments.corpus);
      return kSkipped;
    }
    same = compare(entry, arguments) && same;
  }
  return same ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return lamina::tools::run_measurement(run, argc, argv);
}
