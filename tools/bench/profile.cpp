// The dissertation's table 6.2, figures 6.6, 6.9, 7.3 and 7.4 and table A.1 for any model: patches, points,
// time and memory of the slicing.

#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "engine/import/read_model.h"
#include "engine/slicer.h"
#include "tools/bench/allocation_meter.h"
#include "tools/bench/chart.h"
#include "tools/bench/corpus_models.h"
#include "tools/bench/measurement.h"
#include "tools/cli/slice_report.h"

namespace {

using namespace lamina;

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

tools::SliceReport slice(const engine::Model& model, double lambda, double epsilon, double (*clock)()) {
  engine::SliceOptions options;
  options.epsilon = epsilon;
  options.clock = clock;
  tools::SliceReport report;
  report.model = model.name;
  report.epsilon = epsilon;
  report.layer_thickness = lambda;
  const auto planes = tools::dissertation_planes(model, lambda);
  report.layers.reserve(planes.size());
  const double started = clock();
  double own = 0.0;  // of the report itself
  {
    engine::Slicer slicer(model, planes, options);
    while (const auto layer = slicer.next()) {
      const double before = clock();
      report.add(*layer);
      own += clock() - before;
    }
  }
  report.seconds = clock() - started - own;
  report.peak_megabytes = tools::peak_megabytes_so_far();
  return report;
}

std::vector<tools::ChartShare> shares(const tools::SliceReport& report) {
  const tools::StageTotals totals = report.stage_seconds();
  return {{"Patches", totals.front},
          {"Section", totals.section},
          {"Contours", totals.contours},
          {"Fit", totals.fit}};
}

tools::ChartSeries series(const tools::SliceReport& report, const char* name, const char* colour,
                          std::size_t engine::LayerReport::*count) {
  tools::ChartSeries line{name, colour, {}};
  for (const tools::SliceReportRow& row : report.layers)
    line.values.push_back(static_cast<double>(row.report.*count));
  return line;
}

std::string table_a1(const tools::SliceReport& report) {
  std::string text =
      "layer,z_mm,patches_intersected,patches_added,patches_removed,points,control_points,length_mm\n";
  for (const tools::SliceReportRow& row : report.layers) {
    text += fmt::format("{},{:.6f},{},{},{},{},{},{:.4f}\n", row.index, row.z, row.report.active_patches,
                        row.report.patches_added, row.report.patches_removed, row.report.nodes,
                        row.report.control_points, row.length);
  }
  return text;
}

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  if (!stream.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

void print_shares(const char* what, const std::vector<tools::ChartShare>& parts, const char* unit) {
  double whole = 0.0;
  for (const tools::ChartShare& part : parts) whole += part.value;
  fmt::print("{}: {:.4g} {}", what, whole, unit);
  for (const tools::ChartShare& part : parts)
    fmt::print(", {} {:.1f} %", part.name, whole > 0.0 ? 100.0 * part.value / whole : 0.0);
  fmt::print("\n");
}

int run(int argc, char** argv) {
  constexpr int kSkipped = 77;
  std::string corpus = LAMINA_CORPUS_DIR;
  std::string file;
  std::string folder;
  double lambda = 0.1;
  double epsilon = 0.01;
  bool quick = false;
  CLI::App app("Where patches, points, time and memory go");
  app.add_option("--corpus", corpus, "Folder with the model corpus");
  app.add_option("MODEL", file, "A model file; none: the vertebra of the corpus");
  app.add_option("-o,--output", folder,
                 "Folder for the pictures, the table and the JSON report; none: figures only");
  app.add_option("--lambda", lambda, "Layer thickness, mm");
  app.add_option("--epsilon", epsilon, "Tolerance, mm");
  app.add_flag("--quick", quick, "Lambda 1, epsilon 0.05");
  CLI11_PARSE(app, argc, argv);
  if (quick) {
    lambda = 1.0;
    epsilon = 0.05;
  }
  if (file.empty()) {
    const auto models = tools::corpus_models(corpus, {"seed/vertebra504"});
    if (models.empty()) {
      fmt::print(stderr, "{}: the corpus is needed for this measurement\n", corpus);
      return kSkipped;
    }
    file = models.front().file.string();
  }
  const engine::Model model = engine::read_model(file).model;
  tools::SliceReport report = slice(model, lambda, epsilon, seconds_now);
  // With a clock that counts memory instead of time the stages' "seconds" are what they allocate.
  const tools::SliceReport memory = slice(model, lambda, epsilon, tools::allocated_megabytes);
  report.patches = tools::patch_figures(model);

  fmt::print("{}, lambda {} mm, epsilon {} mm: {} layers\n", report.model, lambda, epsilon,
             report.layers.size());
  fmt::print("table 6.2: {} surfaces, {} patches, average extent {:.6f} mm, deviation {:.6f} mm\n",
             report.patches.surfaces, report.patches.patches, report.patches.average_extent,
             report.patches.extent_deviation);
  print_shares("figure 7.3, time", shares(report), "s");
  print_shares("figure 7.4, memory allocated in all", shares(memory), "MB");
  fmt::print("peak memory of the process {:.1f} MB, model and report included\n", report.peak_megabytes);
  const bool sound = !report.layers.empty() && memory.layers.size() == report.layers.size();
  if (folder.empty()) return sound ? 0 : 1;

  const std::filesystem::path out = folder;
  std::filesystem::create_directories(out);
  write(out / "figure_6_6.svg",
        tools::line_chart("Patches: active, added, removed", "layer",
                          {series(report, "active", "#333", &engine::LayerReport::active_patches),
                           series(report, "added", "#2a7", &engine::LayerReport::patches_added),
                           series(report, "removed", "#c33", &engine::LayerReport::patches_removed)}));
  write(out / "figure_6_9.svg",
        tools::line_chart("Points on each layer", "layer",
                          {series(report, "points", "#333", &engine::LayerReport::nodes),
                           series(report, "control points", "#27c", &engine::LayerReport::control_points)}));
  write(out / "figure_7_3.svg", tools::share_chart("Time by stage", shares(report), "s"));
  write(out / "figure_7_4.svg", tools::share_chart("Memory allocated by stage", shares(memory), "MB"));
  write(out / "table_a1.csv", table_a1(report));
  write(out / "report.json", tools::to_text(tools::to_json(report)) + "\n");
  return sound ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return lamina::tools::run_measurement(run, argc, argv);
}
