// One thread against two, in turn, on the same model: the ratio of the times, and whether the bytes are the
// same. Beside it what the machine gives: as many slicings apart from each other at once, each on one thread.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "engine/import/read_model.h"
#include "engine/slicer.h"
#include "tools/bench/corpus_models.h"
#include "tools/bench/layer_bytes.h"
#include "tools/bench/measurement.h"
#include "tools/bench/slice_run.h"

namespace {

using namespace lamina;

std::string all_bytes(const engine::Model& model, const std::vector<engine::SlicePlane>& planes,
                      const engine::SliceOptions& options) {
  std::string bytes;
  engine::Slicer slicer(model, planes, options);
  while (const auto layer = slicer.next()) bytes += tools::bytes_of(*layer);
  return bytes;
}

/// How many processes wanted to run over the last minute.
double machine_load() {
  double load = 0.0;
  return getloadavg(&load, 1) == 1 ? load : 0.0;
}

/// Mean seconds of `count` slicings at once that share nothing, one thread each.
double seconds_apart(const engine::Model& model, const std::vector<engine::SlicePlane>& planes,
                     const engine::SliceOptions& one, int count) {
  std::vector<double> seconds(static_cast<std::size_t>(count));
  std::vector<std::jthread> slicings;
  for (double& each : seconds)
    slicings.emplace_back([&] { each = tools::slice_once(model, planes, one).seconds; });
  slicings.clear();
  return std::accumulate(seconds.begin(), seconds.end(), 0.0) / count;
}

int run(int argc, char** argv) {
  constexpr int kSkipped = 77;
  std::string corpus = LAMINA_CORPUS_DIR;
  std::vector<std::string> models{"seed/"};
  double lambda = 0.1;
  double epsilon = 0.01;
  double least = 0.0;
  int threads = 2;
  int pairs = 9;
  bool quick = false;
  CLI::App app("The gain of several threads, and that they change nothing");
  app.add_option("--corpus", corpus, "Folder with the model corpus");
  app.add_option("--model", models, "Part of a file's name; repeat for several");
  app.add_option("--lambda", lambda, "Layer thickness, mm");
  app.add_option("--epsilon", epsilon, "Tolerance, mm");
  app.add_option("--threads", threads, "Against one");
  app.add_option("--pairs", pairs, "Pairs of runs, of whose ratios the median counts");
  app.add_option("--least", least, "Fail when the gain is below this");
  app.add_flag("--quick", quick, "Lambda 1, epsilon 0.05, one pair: bytes only");
  CLI11_PARSE(app, argc, argv);
  if (quick) {
    lambda = 1.0;
    epsilon = 0.05;
    pairs = 1;
  }
  const auto files = tools::corpus_models(corpus, models);
  if (files.empty()) {
    fmt::print(stderr, "{}: the corpus is needed for this measurement\n", corpus);
    return kSkipped;
  }
  fmt::print("load of the machine {:.2f}\n", machine_load());
  fmt::print("{:<28} {:>10} {:>10} {:>8} {:>8} {:>12} {}\n", "", "1 thread s", "more s", "gain", "apart",
             "bytes", "same");
  bool holds = true;
  for (const tools::CorpusModel& entry : files) {
    const engine::Model model = engine::read_model(entry.file).model;
    const auto planes = tools::dissertation_planes(model, lambda);
    engine::SliceOptions one;
    one.epsilon = epsilon;
    engine::SliceOptions more = one;
    more.threads = threads;
    const std::string expected = all_bytes(model, planes, one);
    bool same = true;
    for (const int count : {2, 3, 5}) {
      engine::SliceOptions options = one;
      options.threads = count;
      same = same && all_bytes(model, planes, options) == expected;
    }
    std::vector<double> gains;
    std::vector<double> apart;
    double one_seconds = 1e300;
    double more_seconds = 1e300;
    for (int k = 0; k < pairs; ++k) {
      const double a = tools::slice_once(model, planes, one).seconds;
      const double b = tools::slice_once(model, planes, more).seconds;
      gains.push_back(a / b);
      apart.push_back(threads * a / seconds_apart(model, planes, one, threads));
      one_seconds = std::min(one_seconds, a);
      more_seconds = std::min(more_seconds, b);
    }
    const double gain = tools::middle_of(gains);
    fmt::print("{:<28} {:>10.4f} {:>10.4f} {:>8.2f} {:>8.2f} {:>12} {}\n", entry.name, one_seconds,
               more_seconds, gain, tools::middle_of(apart), expected.size(), same ? "yes" : "NO");
    std::fflush(stdout);
    holds = holds && same && gain >= least;
  }
  return holds ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return lamina::tools::run_measurement(run, argc, argv);
}
