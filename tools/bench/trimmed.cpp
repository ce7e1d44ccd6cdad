// What trim curves cost: surfaces cut into cells by curved trim curves against the same surfaces cut into as
// many untrimmed pieces, so that both have the same contours; and parts of trimmed surfaces against untrimmed
// ones, by length of contour. Slicing only: reading is not counted. Fails where a trimmed model takes more
// than 1.5 times as long, or where the contours of equal models are not equally long.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "engine/import/read_model.h"
#include "engine/nurbs/knot_insertion.h"
#include "engine/nurbs/restrict.h"
#include "engine/nurbs/reverse.h"
#include "tools/bench/corpus_models.h"
#include "tools/bench/measurement.h"
#include "tools/bench/slice_run.h"

namespace {

using namespace lamina;
using engine::NurbsCurve;
using engine::NurbsSurface;
using engine::Vector2;
using engine::Vector4;

constexpr double kMostTimes = 1.5;
constexpr double kSameLength = 1e-3;

Vector4 in_plane(const Vector2& at) {
  return {at.x(), at.y(), 0.0, 1.0};
}

/// The side from one corner of a cell to the next: an S beside the straight line, a part of its length wide,
/// with inner knots as trim curves of CAD programs have them.
NurbsCurve side(const Vector2& from, const Vector2& to, double wave) {
  const Vector2 third = (to - from) / 3.0;
  const Vector2 beside = wave * Vector2(-(to - from).y(), (to - from).x());
  const NurbsCurve plain{
      3,
      {0, 0, 0, 0, 1, 1, 1, 1},
      {in_plane(from), in_plane(from + third + beside), in_plane(to - third - beside), in_plane(to)}};
  return engine::insert_knots(plain, {0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875});
}

/// The surface as a grid of cells: untrimmed pieces, or trimmed ones that share curved sides.
std::vector<engine::Surface> cells_of(const engine::Surface& whole, int count, bool trimmed) {
  constexpr double kWave = 0.25;
  const NurbsSurface& nurbs = whole.nurbs;
  const Vector2 low(nurbs.first_u(), nurbs.first_v());
  const Vector2 step = (Vector2(nurbs.last_u(), nurbs.last_v()) - low) / count;
  const auto corner = [&](int i, int j) {
    return Vector2(i == count ? nurbs.last_u() : low.x() + i * step.x(),
                   j == count ? nurbs.last_v() : low.y() + j * step.y());
  };
  // On the border of the surface sides are straight. The wave is measured in cells, not in parameters.
  const auto along_u = [&](int i, int j) {
    const double wave = j == 0 || j == count ? 0.0 : kWave * step.y() / step.x();
    return side(corner(i, j), corner(i + 1, j), wave);
  };
  const auto along_v = [&](int i, int j) {
    const double wave = i == 0 || i == count ? 0.0 : kWave * step.x() / step.y();
    return side(corner(i, j), corner(i, j + 1), wave);
  };
  std::vector<engine::Surface> cells;
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      engine::Surface cell = whole;
      if (!trimmed) {
        const Vector2 a = corner(i, j);
        const Vector2 b = corner(i + 1, j + 1);
        cell.nurbs = engine::restricted(nurbs, a.x(), b.x(), a.y(), b.y());
        cells.push_back(std::move(cell));
        continue;
      }
      const auto backwards = [](const NurbsCurve& curve) { return engine::reversed(curve); };
      cell.trim = {
          {{along_u(i, j), along_v(i + 1, j), backwards(along_u(i, j + 1)), backwards(along_v(i, j))}}};
      // As readers leave it: the surface reaches as far as the box of its loops.
      engine::Box2 box;
      for (const NurbsCurve& curve : cell.trim.front().curves) {
        for (const Vector4& point : curve.control_points) box.extend(Vector2(point.head<2>()));
      }
      cell.nurbs = engine::restricted(
          nurbs, std::max(box.min().x(), nurbs.first_u()), std::min(box.max().x(), nurbs.last_u()),
          std::max(box.min().y(), nurbs.first_v()), std::min(box.max().y(), nurbs.last_v()));
      cells.push_back(std::move(cell));
    }
  }
  return cells;
}

engine::Model in_cells(const engine::Model& model, int count, bool trimmed) {
  engine::Model result;
  for (const engine::Surface& surface : model.surfaces) {
    for (engine::Surface& cell : cells_of(surface, count, trimmed))
      result.surfaces.push_back(std::move(cell));
  }
  return result;
}

struct Arguments {
  std::string corpus = LAMINA_CORPUS_DIR;
  double epsilon = 0.02;
  std::string only;
  int layers = 200;
  int repeats = 7;
  bool times_count = true;
};

/// The fastest run of each of two models, in turns, so that both see the same machine.
struct Pair {
  tools::SliceRun trimmed;
  tools::SliceRun untrimmed;
};

std::vector<engine::SlicePlane> planes_of(const engine::Model& model, const Arguments& arguments) {
  return tools::dissertation_planes(model, engine::control_box(model).sizes().z() / arguments.layers);
}

Pair measure(const engine::Model& trimmed, const std::vector<engine::SlicePlane>& trimmed_planes,
             const engine::Model& untrimmed, const std::vector<engine::SlicePlane>& untrimmed_planes,
             const Arguments& arguments) {
  engine::SliceOptions options;
  options.epsilon = arguments.epsilon;
  Pair best;
  for (int k = 0; k < arguments.repeats; ++k) {
    const tools::SliceRun with = tools::slice_once(trimmed, trimmed_planes, options);
    const tools::SliceRun without = tools::slice_once(untrimmed, untrimmed_planes, options);
    if (k == 0 || with.cpu_seconds < best.trimmed.cpu_seconds) best.trimmed = with;
    if (k == 0 || without.cpu_seconds < best.untrimmed.cpu_seconds) best.untrimmed = without;
  }
  return best;
}

bool judge(const std::string& name, const Pair& pair, bool same_model, const Arguments& arguments) {
  const auto per_metre = [](const tools::SliceRun& run) { return 1e6 * run.cpu_seconds / run.length; };
  const double times = per_metre(pair.trimmed) / per_metre(pair.untrimmed);
  fmt::print("{:34} {:10.4f} {:10.0f} {:9.2f} {:10.4f} {:10.0f} {:9.2f} {:7.2f}\n", name,
             pair.trimmed.cpu_seconds, pair.trimmed.length, per_metre(pair.trimmed),
             pair.untrimmed.cpu_seconds, pair.untrimmed.length, per_metre(pair.untrimmed), times);
  std::fflush(stdout);
  bool holds = true;
  if (arguments.times_count && times > kMostTimes) {
    fmt::print("FAILS: more than {} times as long\n", kMostTimes);
    holds = false;
  }
  if (same_model &&
      std::abs(pair.trimmed.length - pair.untrimmed.length) > kSameLength * pair.untrimmed.length) {
    fmt::print("FAILS: the contours are not equally long\n");
    holds = false;
  }
  return holds;
}

int run(int argc, char** argv) {
  constexpr int kSkipped = 77;
  Arguments arguments;
  bool quick = false;
  CLI::App app("What trim curves cost in slicing");
  app.add_option("--corpus", arguments.corpus, "Folder with the model corpus");
  app.add_option("--epsilon", arguments.epsilon, "Tolerance, mm");
  app.add_option("--layers", arguments.layers, "Number of layers");
  app.add_option("--repeats", arguments.repeats, "Runs, of which the fastest counts");
  app.add_option("--only", arguments.only, "Part of a row's name");
  app.add_flag("--quick", quick, "Few layers, one run, and times do not count");
  CLI11_PARSE(app, argc, argv);
  if (quick) {
    arguments.layers = 20;
    arguments.repeats = 1;
    arguments.times_count = false;
  }
  if (tools::corpus_models(arguments.corpus, {"seed/torus"}).empty()) {
    fmt::print(stderr, "{}: the corpus is needed for this measurement\n", arguments.corpus);
    return kSkipped;
  }
  const auto read = [&](const std::string& name) {
    return engine::read_model(std::filesystem::path(arguments.corpus) / name).model;
  };
  fmt::print("{:34} {:>10} {:>10} {:>9} {:>10} {:>10} {:>9} {:>7}\n", "", "trimmed s", "mm", "us/mm",
             "untrimmed", "mm", "us/mm", "times");
  bool holds = true;
  struct Cells {
    const char* file;
    int count;
  };
  for (const Cells& cells : {Cells{"seed/torus.igs", 4}, Cells{"seed/trefoil_swept.igs", 8},
                             Cells{"freeform/teapot28.igs", 3}, Cells{"analytic/sphere_r10.igs", 3},
                             Cells{"analytic/sphere_r10.igs", 6}, Cells{"seed/torus.igs", 12}}) {
    const std::string name = fmt::format("{} in {} x {}", cells.file, cells.count, cells.count);
    if (name.find(arguments.only) == std::string::npos) continue;
    const engine::Model model = read(cells.file);
    const auto planes = planes_of(model, arguments);
    const Pair pair = measure(in_cells(model, cells.count, true), planes, in_cells(model, cells.count, false),
                              planes, arguments);
    holds = judge(name, pair, true, arguments) && holds;
  }
  struct Parts {
    const char* trimmed;
    const char* untrimmed;
  };
  for (const Parts& parts : {Parts{"entities/trim144_pcurves.igs", "analytic/box_hole.igs"},
                             Parts{"parts/part_bracket_144.igs", "analytic/box_hole.igs"},
                             Parts{"parts/part_bracket_nurbs_144.igs", "analytic/box_hole.igs"}}) {
    const auto stem = [](const char* file) { return std::filesystem::path(file).stem().string(); };
    const std::string name = fmt::format("{} / {}", stem(parts.trimmed), stem(parts.untrimmed));
    if (name.find(arguments.only) == std::string::npos) continue;
    const engine::Model trimmed = read(parts.trimmed);
    const engine::Model untrimmed = read(parts.untrimmed);
    const Pair pair = measure(trimmed, planes_of(trimmed, arguments), untrimmed,
                              planes_of(untrimmed, arguments), arguments);
    holds = judge(name, pair, false, arguments) && holds;
  }
  return holds ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return lamina::tools::run_measurement(run, argc, argv);
}
