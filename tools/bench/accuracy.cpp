// The accuracy test of the dissertation's chapter seven (p. 163 to 172), on every model of the corpus and
// both ways: points of the contours are projected onto the surfaces, and points of the true section, found by
// a route of their own, are looked for on the contours.

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "engine/import/read_model.h"
#include "engine/slicer.h"
#include "tools/bench/contour_distance.h"
#include "tools/bench/corpus_models.h"
#include "tools/bench/damage.h"
#include "tools/bench/dissertation_models.h"
#include "tools/bench/measurement.h"
#include "tools/bench/surface_distance.h"
#include "tools/bench/true_section.h"

namespace {

using namespace lamina;
using engine::Vector2;
using engine::Vector3;

constexpr double kSamplesPerLength = 0.001;
constexpr double kStepInEpsilon = 4.0;
/// Distances up to this many epsilon may be bounds from above instead of the distances themselves.
constexpr double kEnough = 0.02;
constexpr double kTrusted = 0.1;
constexpr double kSpacingInEpsilon = 10.0;
constexpr double kFinestSpacing = 0.25;  // mm
constexpr unsigned kSeed = 7;
constexpr double kLeastWinding = 0.3;

// What is promised, in epsilon.
constexpr double kMostAverage = 0.05;
constexpr double kMost = 1.0;
constexpr double kMostMissed = 1.5;

const std::vector<std::string> kExtensions{".igs", ".iges", ".stp", ".step", ".stl", ".obj", ".3mf"};

struct Extreme {
  double distance = 0.0;
  Vector3 place = Vector3::Zero();

  void note(double found, const Vector3& where) {
    if (found > distance) *this = {found, where};
  }
};

struct Cell {
  const tools::CorpusModel* model = nullptr;
  double lambda = 0.0;
  double epsilon = 0.0;
};

struct CellResult {
  double distance_sum = 0.0;
  std::size_t points = 0;
  Extreme greatest;
  std::size_t true_points = 0;
  Extreme greatest_missed;
  std::size_t damaged = 0;       ///< points beside defects, left out both ways
  std::size_t bridged = 0;       ///< points beside gaps that the slice report names, left out both ways
  std::size_t inside_union = 0;  ///< true points inside of several solids at once
  std::size_t layers = 0;
  double slicing_seconds = 0.0;
  std::string failure;

  double average() const { return points == 0 ? 0.0 : distance_sum / static_cast<double>(points); }
};

struct Arguments {
  std::string corpus = LAMINA_CORPUS_DIR;
  std::vector<std::string> models;
  std::vector<double> lambdas{0.5, 0.1, 0.05};
  std::vector<double> epsilons{0.1, 0.05, 0.01};
  std::size_t most_layers = 1000000;
  int jobs = 1;
  bool dissertation = false;
};

bool on_bridge(const engine::LayerReport& report, const Vector2& place, double epsilon) {
  const auto near = [&](const engine::BridgedGap& gap) {
    const Vector2 middle = 0.5 * (gap.from + gap.to);
    return (place - middle).norm() <= 0.5 * gap.width() + epsilon;
  };
  return std::any_of(report.bridged_gaps.begin(), report.bridged_gaps.end(), near);
}

void measure_contours(const engine::Layer& layer, const Cell& cell, bool as_dissertation,
                      const tools::SurfaceDistance& surfaces, const std::vector<tools::Damage>& damage,
                      CellResult& result) {
  for (const engine::PieceCurve* curve : tools::curves_of(layer)) {
    const double length = engine::length(*curve);
    const double step = as_dissertation ? kSamplesPerLength * length
                                        : std::max(kStepInEpsilon * cell.epsilon, kSamplesPerLength * length);
    for (const Vector2& point : engine::sample_evenly(*curve, step)) {
      const Vector3 place(point.x(), point.y(), layer.plane.z);
      if (tools::is_damaged(damage, place)) {
        ++result.damaged;
        continue;
      }
      if (on_bridge(layer.report, point, cell.epsilon)) {
        ++result.bridged;
        continue;
      }
      const double distance = surfaces.distance(place, {kEnough * cell.epsilon, kTrusted * cell.epsilon});
      result.distance_sum += distance;
      result.greatest.note(distance, place);
      ++result.points;
    }
  }
}

/// Sections a little below and above a plane, made when they are first needed: in the plane itself edges of
/// patches may lie. Their pieces are finer than the points looked for: folds are to show in them.
class SectionsBeside {
 public:
  SectionsBeside(tools::TrueSectioner& sectioner, double z, double spacing)
      : sectioner_(sectioner), z_(z), spacing_(spacing) {}

  struct Beside {
    tools::TrueSection section;
    tools::KnownSolids solids;
  };

  const std::vector<Beside>& get() {
    if (sections_.empty()) {
      for (const double sign : {-1.0, 1.0}) {
        tools::TrueSection section = sectioner_.at(z_ + sign * kBeside, spacing_ / kFiner);
        tools::KnownSolids solids(section);
        sections_.push_back({std::move(section), std::move(solids)});
      }
    }
    return sections_;
  }

 private:
  static constexpr double kBeside = 1e-4;  // mm
  static constexpr double kFiner = 16.0;

  tools::TrueSectioner& sectioner_;
  double z_;
  double spacing_;
  std::vector<Beside> sections_;
};

/// Whether a point of a surface has the solid on both sides: where solids overlap, no outline runs there. The
/// winding number jumps by one across the surface; of a shell that ends inside another it may come near to
/// zero on one side, but not change its sign. Between the chords of two known solids that share a surface a
/// place may seem to be in neither: one alone, or two on opposite sides, is no outside.
bool inside_union(const Vector3& place, double epsilon, SectionsBeside& sections) {
  // Towards the corners of a square, so that one of the ways is well off the surface.
  const Vector2 ways[] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  for (const auto& [section, solids] : sections.get()) {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    std::array<bool, 4> outside{};
    for (std::size_t k = 0; k < outside.size(); ++k) {
      const Vector2 beside = place.head<2>() + 0.5 * epsilon * ways[k];
      if (solids.contains(beside)) continue;
      outside[k] = true;
      const double winding = tools::winding_number(section, beside);
      least = std::min(least, winding);
      most = std::max(most, winding);
    }
    const bool neighbours = (outside[0] || outside[2]) && (outside[1] || outside[3]);
    if (!solids.none() && !neighbours) continue;
    if (least < kLeastWinding && most > -kLeastWinding) return false;
  }
  return true;
}

void measure_section(const engine::Layer& layer, const Cell& cell, const tools::TrueSection& section,
                     SectionsBeside sections, const std::vector<tools::Damage>& damage, CellResult& result) {
  const tools::ContourDistance contours(layer, kEnough * cell.epsilon);
  const auto look_for = [&](const Vector2& point, bool in_plane) {
    const Vector3 place(point.x(), point.y(), layer.plane.z);
    if (tools::is_damaged(damage, place)) {
      ++result.damaged;
      return;
    }
    const double distance = contours.distance(point, 0.5 * cell.epsilon);
    if (distance > 0.5 * cell.epsilon && in_plane && contours.in_face(point)) return;
    if (distance > kMostMissed * cell.epsilon) {
      if (on_bridge(layer.report, point, cell.epsilon)) {
        ++result.bridged;
        return;
      }
      if (inside_union(place, cell.epsilon, sections)) {
        ++result.inside_union;
        return;
      }
    }
    ++result.true_points;
    result.greatest_missed.note(distance, place);
  };
  for (const Vector2& point : section.crossings) look_for(point, false);
  for (const Vector2& point : section.in_plane) look_for(point, true);
}

std::vector<engine::SlicePlane> planes_of(const engine::Model& model, const Cell& cell,
                                          std::size_t most_layers) {
  std::vector<engine::SlicePlane> planes = tools::dissertation_planes(model, cell.lambda);
  if (planes.size() <= most_layers) return planes;
  std::vector<engine::SlicePlane> some;
  for (std::size_t k = 0; k < most_layers; ++k) some.push_back(planes[k * planes.size() / most_layers]);
  return some;
}

CellResult run_cell(const Cell& cell, const Arguments& arguments) {
  using Clock = std::chrono::steady_clock;
  const engine::Model model = engine::read_model(cell.model->file).model;
  const std::vector<tools::Damage> damage = tools::damage_of(cell.model->file, model);
  engine::SliceOptions options;
  options.epsilon = cell.epsilon;
  tools::SurfaceDistance surfaces(model);
  tools::TrueSectioner true_sections(model, kSeed);
  const double spacing = std::max(kFinestSpacing, kSpacingInEpsilon * cell.epsilon);
  CellResult result;
  auto started = Clock::now();
  engine::Slicer slicer(model, planes_of(model, cell, arguments.most_layers), options);
  while (const auto layer = slicer.next()) {
    result.slicing_seconds += std::chrono::duration<double>(Clock::now() - started).count();
    surfaces.select_plane(layer->plane.z, 2.0 * cell.epsilon);
    measure_contours(*layer, cell, arguments.dissertation, surfaces, damage, result);
    measure_section(*layer, cell, true_sections.at(layer->plane.z, spacing),
                    SectionsBeside(true_sections, layer->plane.z, spacing), damage, result);
    ++result.layers;
    started = Clock::now();
  }
  return result;
}

std::string left_out(const CellResult& result) {
  std::string text;
  const auto add = [&](std::size_t count, const char* what) {
    if (count > 0) text += fmt::format(" {} {},", count, what);
  };
  add(result.damaged, "beside defects");
  add(result.bridged, "on bridged gaps");
  add(result.inside_union, "inside a union");
  if (!text.empty()) text.pop_back();
  return text;
}

/// One row in the form of tables 7.1 to 7.6. Returns whether all that is promised holds.
bool print_row(const Cell& cell, const CellResult& result) {
  if (!result.failure.empty()) {
    fmt::print("{:<8} {:<8} {}\n", cell.lambda, cell.epsilon, result.failure);
    return false;
  }
  const bool average_holds = result.average() <= kMostAverage * cell.epsilon;
  const bool greatest_holds = result.greatest.distance <= kMost * cell.epsilon;
  const bool missed_holds = result.greatest_missed.distance <= kMostMissed * cell.epsilon;
  fmt::print("{:<8} {:<8} {:>12.2e} {:>10} {:>9.4f} {:>9.4f} {:>10} {:>9.4f} {:>7} {:>9.2f} {}{}\n",
             cell.lambda, cell.epsilon, result.average(), result.points, result.average() / cell.epsilon,
             result.greatest.distance / cell.epsilon, result.true_points,
             result.greatest_missed.distance / cell.epsilon, result.layers, result.slicing_seconds,
             average_holds && greatest_holds && missed_holds ? "" : "FAILS", left_out(result));
  const auto say_where = [](const char* what, const Extreme& extreme) {
    fmt::print("    {}: {:.3g} mm at ({:.6f}, {:.6f}, {:.6f})\n", what, extreme.distance, extreme.place.x(),
               extreme.place.y(), extreme.place.z());
  };
  if (!greatest_holds) say_where("contour farthest from the surfaces", result.greatest);
  if (!missed_holds) say_where("section farthest from the contours", result.greatest_missed);
  std::fflush(stdout);
  return average_holds && greatest_holds && missed_holds;
}

void print_head(const tools::CorpusModel& model) {
  std::string title = model.name;
  for (const tools::DissertationModel& entry : tools::dissertation_models()) {
    if (entry.corpus_file == model.name)
      title = fmt::format("Table {} - {} ({}) model test results", entry.table, entry.name, model.name);
  }
  fmt::print("\n{}\n{:<8} {:<8} {:>12} {:>10} {:>9} {:>9} {:>10} {:>9} {:>7} {:>9} left out\n", title,
             "lambda", "epsilon", "Avg Distance", "Points", "avg/eps", "max/eps", "True Pts", "miss/eps",
             "Layers", "Slicing s");
}

/// All cells on `jobs` threads; rows are printed in order. Returns whether everything holds.
bool run_cells(const std::vector<Cell>& cells, const Arguments& arguments) {
  std::vector<CellResult> results(cells.size());
  std::vector<bool> finished(cells.size(), false);
  std::atomic<std::size_t> next = 0;
  std::mutex printing;
  std::size_t printed = 0;
  bool holds = true;
  const auto work = [&] {
    for (std::size_t k = next++; k < cells.size(); k = next++) {
      try {
        results[k] = run_cell(cells[k], arguments);
      } catch (const std::exception& error) {
        results[k].failure = error.what();
      }
      const std::lock_guard lock(printing);
      finished[k] = true;
      for (; printed < cells.size() && finished[printed]; ++printed) {
        if (printed == 0 || cells[printed].model != cells[printed - 1].model)
          print_head(*cells[printed].model);
        holds = print_row(cells[printed], results[printed]) && holds;
      }
    }
  };
  std::vector<std::jthread> threads;
  for (int k = 1; k < arguments.jobs; ++k) threads.emplace_back(work);
  work();
  threads.clear();
  return holds;
}

int run(int argc, char** argv) {
  constexpr int kSkipped = 77;
  Arguments arguments;
  bool quick = false;
  CLI::App app(
      "Distances from contours to surfaces and back, as in the dissertation's tables 7.1 to 7.6. Fails "
      "where\n"
      "an average is over 0.05 epsilon, a contour over 1 epsilon off, or a point of the true section over "
      "1.5\n"
      "epsilon from every contour.");
  app.add_option("--corpus", arguments.corpus, "Folder with the model corpus");
  app.add_option("--model", arguments.models, "Part of a file's name, such as torus; repeat for several");
  app.add_flag("--dissertation", arguments.dissertation,
               "The dissertation's six models, sampled at a thousandth of each contour's length");
  app.add_option("--lambda", arguments.lambdas, "Layer thicknesses, mm")->delimiter(',');
  app.add_option("--epsilon", arguments.epsilons, "Tolerances, mm")->delimiter(',');
  app.add_option("--most-layers", arguments.most_layers, "Of more, evenly spread ones are measured");
  app.add_option("--jobs", arguments.jobs, "Cells measured at the same time");
  app.add_flag("--quick", quick, "Few layers of some models, epsilon 0.1 and 0.01");
  CLI11_PARSE(app, argc, argv);
  if (quick) {
    arguments.models = {"seed/", "teapot28", "analytic/"};
    arguments.lambdas = {0.5};
    arguments.epsilons = {0.1, 0.01};
    arguments.most_layers = 5;
  }

  std::vector<tools::CorpusModel> models =
      tools::corpus_models(arguments.corpus, arguments.models, kExtensions);
  if (models.empty()) {
    fmt::print(stderr, "{}: no such models; the corpus is needed for this test\n", arguments.corpus);
    return kSkipped;
  }
  if (arguments.dissertation) {
    const auto six = tools::dissertation_models();
    std::erase_if(models, [&](const tools::CorpusModel& model) {
      return std::none_of(six.begin(), six.end(),
                          [&](const auto& entry) { return entry.corpus_file == model.name; });
    });
  }
  std::vector<Cell> cells;
  for (const tools::CorpusModel& model : models) {
    for (const double lambda : arguments.lambdas) {
      for (const double epsilon : arguments.epsilons) cells.push_back({&model, lambda, epsilon});
    }
  }
  return run_cells(cells, arguments) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return lamina::tools::run_measurement(run, argc, argv);
}
