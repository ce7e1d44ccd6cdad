// How near the engine is to what the surfaces themselves cost: nanoseconds per cell of contour (length over
// epsilon), everything included, in evaluations of one patch. At most 8.

#include <chrono>
#include <cstdio>
#include <exception>
#include <random>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "engine/import/read_model.h"
#include "tools/bench/corpus_models.h"
#include "tools/bench/dissertation_models.h"
#include "tools/bench/measurement.h"
#include "tools/bench/patch_evaluation.h"
#include "tools/bench/slice_run.h"

namespace {

using namespace lamina;

constexpr double kMostEvaluations = 8.0;

/// Position and first derivatives of a rational bicubic patch, ns; the fastest of several rounds.
double evaluation_nanoseconds() {
  constexpr int kRounds = 20;
  constexpr int kEvaluations = 20000;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(0.5, 1.5);
  engine::BezierPatch patch;
  patch.degree_u = patch.degree_v = 3;
  patch.net.count_u = patch.net.count_v = 4;
  for (int k = 0; k < 16; ++k)
    patch.net.points.emplace_back(number(random), number(random), number(random), number(random));
  double best = 1e9;
  volatile double sink = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    const auto started = std::chrono::steady_clock::now();
    double sum = 0.0;
    for (int k = 0; k < kEvaluations; ++k) {
      const double t = static_cast<double>(k) / kEvaluations;
      const tools::PatchPoint at = tools::evaluate_with_derivatives(patch, t, 1.0 - t);
      sum += at.point.x() + at.du.y() + at.dv.z();
    }
    sink = sink + sum;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    best = std::min(best, 1e9 * seconds / kEvaluations);
  }
  return best;
}

int run(int argc, char** argv) {
  constexpr int kSkipped = 77;
  std::string corpus = LAMINA_CORPUS_DIR;
  std::vector<std::string> models;
  std::vector<double> epsilons{0.1, 0.05, 0.01};
  double lambda = 0.1;
  int repeats = 5;
  bool quick = false;
  CLI::App app("Nanoseconds per cell of contour, in evaluations of a patch");
  app.add_option("--corpus", corpus, "Folder with the model corpus");
  app.add_option("--model", models,
                 "Part of a file's name; none: equivalents of the dissertation's six models");
  app.add_option("--lambda", lambda, "Layer thickness, mm");
  app.add_option("--epsilon", epsilons, "Tolerances, mm")->delimiter(',');
  app.add_option("--repeats", repeats, "Runs, of which the fastest counts");
  app.add_flag("--quick", quick, "The vertebra at lambda 1, epsilon 0.01");
  CLI11_PARSE(app, argc, argv);
  if (quick) {
    models = {"seed/vertebra504"};
    lambda = 1.0;
    epsilons = {0.01};
    repeats = 3;
  }
  if (models.empty()) {
    for (const auto& entry : tools::dissertation_models()) models.push_back(entry.corpus_file);
  }
  const auto files = tools::corpus_models(corpus, models);
  if (files.empty()) {
    fmt::print(stderr, "{}: the corpus is needed for this measurement\n", corpus);
    return kSkipped;
  }
  const double evaluation = evaluation_nanoseconds();
  fmt::print("one evaluation of a bicubic patch: {:.1f} ns\n", evaluation);
  fmt::print("{:<28} {:>8} {:>12} {:>10} {:>10} {:>12}\n", "", "epsilon", "cells", "CPU s", "ns a cell",
             "evaluations");
  bool holds = true;
  for (const tools::CorpusModel& entry : files) {
    const engine::Model model = engine::read_model(entry.file).model;
    const auto planes = tools::dissertation_planes(model, lambda);
    for (const double epsilon : epsilons) {
      engine::SliceOptions options;
      options.epsilon = epsilon;
      tools::SliceRun best = tools::slice_once(model, planes, options);
      for (int k = 1; k < repeats; ++k) {
        const tools::SliceRun again = tools::slice_once(model, planes, options);
        if (again.cpu_seconds < best.cpu_seconds) best = again;
      }
      const double cells = best.length / epsilon;
      const double nanoseconds = 1e9 * best.cpu_seconds / cells;
      fmt::print("{:<28} {:>8} {:>12.0f} {:>10.4f} {:>10.1f} {:>12.2f}{}\n", entry.name, epsilon, cells,
                 best.cpu_seconds, nanoseconds, nanoseconds / evaluation,
                 nanoseconds / evaluation <= kMostEvaluations ? "" : " FAILS");
      std::fflush(stdout);
      holds = holds && nanoseconds / evaluation <= kMostEvaluations;
    }
  }
  return holds ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return lamina::tools::run_measurement(run, argc, argv);
}
