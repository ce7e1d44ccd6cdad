// lamina's engine against the dense method on random solids: number, kind and nesting of the contours of
// every layer. A third judge has to confirm the engine on every one of them: the union of the solids' true
// sections, found on parameter lines and united by Clipper, which shares no code with either. Where the dense
// method differs it is thereby proved wrong, and its reason is counted; everything else fails.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "engine/model_bounds.h"
#include "engine/slicer.h"
#include "gcode/region/polygon_clipping.h"
#include "tests/reference/as_engine_layer.h"
#include "tests/reference/reference_slicer.h"
#include "tests/support/contour_measure.h"
#include "tools/bench/contour_kinds.h"
#include "tools/bench/measurement.h"
#include "tools/bench/random_solids.h"
#include "tools/bench/true_union.h"

namespace {

using namespace lamina;

constexpr double kFlattened = 0.05;  // of epsilon
/// Spacing of the judge's lines, mm; tried in turn where the judge is of another opinion than the engine.
constexpr double kSpacings[] = {0.08, 0.03, 0.012};
/// Narrower islands and holes may be rounding, or may not; both are tried.
constexpr double kNarrowest = 1e-4;  // mm
/// Fitted curves and chords for measuring, together, in epsilon.
constexpr double kChordsOff = 0.1;
/// What the dense method cannot tell apart, in cells: the marked cells on both sides of a line, and one
/// between.
constexpr double kUnresolvedCells = 3.0;

/// Why the dense method differs, each confirmed by the judge.
struct Tally {
  std::size_t models = 0;
  std::size_t layers = 0;
  std::size_t equal = 0;       ///< and the judge agrees
  std::size_t unions = 0;      ///< solids meet: it keeps the outside of what is connected, and loses holes
  std::size_t unresolved = 0;  ///< contours nearer to each other, or smaller, than it can resolve
  std::size_t thick = 0;  ///< thick lines of cells, where a surface leans on the plane, traced as contours
  std::size_t swallowed = 0;    ///< a solid, or a hole of one, wholly within another solid: lamina goes by
                                ///< parity, as is its rule
  std::size_t grazing = 0;      ///< solids overlap, lie within one another, or fail to, by less than the
                                ///< engine's chords may be off
  std::size_t dense_areas = 0;  ///< equal contours, but the dense method's area is wrong by more than a cell
  std::size_t wrong = 0;
  std::size_t areas = 0;  ///< equal contours whose areas differ by more than a cell along them

  void add(const Tally& other) {
    models += other.models;
    layers += other.layers;
    equal += other.equal;
    unions += other.unions;
    unresolved += other.unresolved;
    thick += other.thick;
    swallowed += other.swallowed;
    grazing += other.grazing;
    dense_areas += other.dense_areas;
    wrong += other.wrong;
    areas += other.areas;
  }
};

/// Whether a loop is smaller than `distance`, or two places that are far apart along the loops come nearer.
bool comes_near(const std::vector<engine::Loop>& loops, double distance) {
  for (const engine::Loop& loop : loops) {
    engine::Box2 box;
    for (const engine::Vector2& point : loop) box.extend(point);
    if (box.sizes().minCoeff() < 2.0 * distance) return true;
    const double whole = engine::perimeter(loop);
    std::vector<double> reached{0.0};
    for (std::size_t k = 1; k < loop.size(); ++k)
      reached.push_back(reached.back() + (loop[k] - loop[k - 1]).norm());
    for (const engine::Loop& other : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        for (std::size_t j = 0; j < other.size(); ++j) {
          const engine::Vector2 along = other[(j + 1) % other.size()] - other[j];
          const double t =
              std::clamp((loop[i] - other[j]).dot(along) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
          const double straight = (other[j] + t * along - loop[i]).norm();
          if (straight >= distance) continue;
          if (&other != &loop) return true;
          const double apart = std::abs(reached[j] + t * along.norm() - reached[i]);
          if (std::min(apart, whole - apart) > 3.0 * distance) return true;
        }
      }
    }
  }
  return false;
}

std::vector<engine::SlicePlane> planes_through(const engine::Model& model, int count) {
  const engine::Box3 box = engine::model_bounds(model);
  std::vector<engine::SlicePlane> planes;
  for (int k = 0; k < count; ++k) {
    const double z = box.min().z() + box.sizes().z() * (k + 0.5) / count;
    planes.push_back({z, z, z});
  }
  return planes;
}

enum class Verdict { kRefuted, kUnion, kNesting, kWithinTolerance };

/// The regions, each as it is or larger or smaller by `distance` (mm), in all combinations but the first.
std::vector<std::vector<engine::Region>> moved_regions(const std::vector<engine::Region>& regions,
                                                       double distance) {
  std::vector<std::vector<engine::Region>> combinations{{}};
  for (const engine::Region& region : regions) {
    const engine::Region states[] = {region, gcode::offset(region, distance, gcode::Join::kMiter),
                                     gcode::offset(region, -distance, gcode::Join::kMiter)};
    std::vector<std::vector<engine::Region>> longer;
    for (const std::vector<engine::Region>& begun : combinations) {
      for (const engine::Region& state : states) {
        longer.push_back(begun);
        longer.back().push_back(state);
      }
    }
    combinations = std::move(longer);
  }
  combinations.erase(combinations.begin());
  return combinations;
}

/// The judge's word on one layer: whether the contours are those of the union, or of the union but for solids
/// that lie wholly within others, or of either when each solid is larger or smaller by what the engine's
/// chords may be off.
Verdict judged(const tools::RandomSolid& solid, double z, double epsilon, const tools::ContourKinds& kinds,
               std::string& opinion) {
  using Unite = engine::Region (*)(const std::vector<engine::Region>&, double);
  const auto confirms = [&](Unite unite, const std::vector<engine::Region>& regions) {
    return tools::kinds_of(unite(regions, kNarrowest)) == kinds ||
           tools::kinds_of(unite(regions, 0.0)) == kinds;
  };
  for (const double spacing : kSpacings) {
    const auto regions = tools::true_regions(solid.parts, z, spacing);
    if (!regions) continue;
    opinion = tools::described(tools::kinds_of(tools::true_union(*regions, kNarrowest)));
    if (confirms(tools::true_union, *regions)) return Verdict::kUnion;
    if (confirms(tools::true_nesting, *regions)) return Verdict::kNesting;
    for (const auto& moved : moved_regions(*regions, engine::SliceOptions{}.chord_part * epsilon)) {
      if (confirms(tools::true_union, moved) || confirms(tools::true_nesting, moved))
        return Verdict::kWithinTolerance;
    }
  }
  return Verdict::kRefuted;
}

/// One solid, both engines. What is wrong is described in `complaints`.
Tally compare(const tools::RandomSolid& solid, int planes_a_model, double epsilon, std::string& complaints) {
  const std::vector<engine::SlicePlane> planes = planes_through(solid.model, planes_a_model);
  engine::SliceOptions options;
  options.epsilon = epsilon;
  engine::Slicer slicer(solid.model, planes, options);
  reference::SliceOptions dense_options;
  dense_options.layer_thickness = 0.5;
  dense_options.epsilon = epsilon;
  reference::ReferenceSlicer dense(solid.model, planes, dense_options);
  Tally tally;
  tally.models = 1;
  while (const auto layer = slicer.next()) {
    const engine::Layer other = reference::as_engine_layer(*dense.next());
    ++tally.layers;
    const tools::ContourKinds ours = tools::kinds_of(*layer, kFlattened * epsilon);
    const tools::ContourKinds theirs = tools::kinds_of(other, kFlattened * epsilon);
    const std::vector<engine::Loop> loops = tools::closed_loops(*layer, kFlattened * epsilon);
    const double z = layer->plane.z;
    std::string opinion = "no opinion";
    const Verdict verdict = judged(solid, z, epsilon, ours, opinion);
    if (verdict == Verdict::kRefuted) {
      ++tally.wrong;
      complaints += fmt::format("{} at z = {:.17g}: lamina {}; dense {}; truth {}\n", solid.model.name, z,
                                tools::described(ours), tools::described(theirs), opinion);
      continue;
    }
    if (ours == theirs) {
      ++tally.equal;
      // Half a cell along the contour, up to a whole one where the surface leans on the plane.
      const double length = tests::perimeter_of(loops);
      const double area = tests::parity_area(loops);
      const double difference = area - tests::parity_area(tools::closed_loops(other, kFlattened * epsilon));
      if (std::abs(difference) > epsilon * length + 4.0 * epsilon * epsilon) {
        const auto regions = tools::true_regions(solid.parts, z, kSpacings[1]);
        const double truth = regions ? engine::area(tools::true_union(*regions, kNarrowest)) : 0.0;
        if (std::abs(area - truth) <= kChordsOff * epsilon * length) {
          ++tally.dense_areas;
        } else {
          ++tally.areas;
          complaints += fmt::format("{} at z = {:.17g}: area {:.6g} mm^2, dense {:.6g}, truth {:.6g}\n",
                                    solid.model.name, z, area, area - difference, truth);
        }
      }
      continue;
    }
    if (verdict == Verdict::kNesting) {
      ++tally.swallowed;
    } else if (verdict == Verdict::kWithinTolerance) {
      ++tally.grazing;
    } else if (layer->report.meetings > 0) {
      ++tally.unions;
    } else if (comes_near(loops, kUnresolvedCells * epsilon)) {
      ++tally.unresolved;
    } else {
      ++tally.thick;
    }
  }
  return tally;
}

int run(int argc, char** argv) {
  int models = 3000;
  int planes = 5;
  int only = -1;
  int jobs = 1;
  unsigned seed = 20;
  double epsilon = 0.05;
  bool quick = false;
  CLI::App app("lamina's engine against the dense method on random solids, with a third judge");
  app.add_option("--models", models, "Random models");
  app.add_option("--planes", planes, "Through each");
  app.add_option("--epsilon", epsilon, "Tolerance, mm");
  app.add_option("--seed", seed, "Of the models");
  app.add_option("--only", only, "Index of the one model to compare");
  app.add_option("--jobs", jobs, "Models compared at the same time");
  app.add_flag("--quick", quick, "60 models");
  CLI11_PARSE(app, argc, argv);
  if (quick) models = 60;

  // A model depends on its own index and the seed alone.
  const auto solid_of = [&](int index) {
    tools::RandomSolids solids(seed + 7919U * static_cast<unsigned>(index));
    return solids.next(index);
  };
  std::vector<Tally> tallies(static_cast<std::size_t>(models));
  std::vector<std::string> complaints(static_cast<std::size_t>(models));
  std::atomic<int> next = only >= 0 ? only : 0;
  const int end = only >= 0 ? only + 1 : models;
  if (only >= models) return 1;
  const auto work = [&] {
    for (int k = next++; k < end; k = next++) {
      const auto slot = static_cast<std::size_t>(k);
      try {
        tallies[slot] = compare(solid_of(k), planes, epsilon, complaints[slot]);
      } catch (const std::exception& error) {
        tallies[slot].wrong = 1;
        complaints[slot] = fmt::format("random {}: {}\n", k, error.what());
      }
    }
  };
  std::vector<std::jthread> threads;
  for (int k = 1; k < jobs; ++k) threads.emplace_back(work);
  work();
  threads.clear();
  Tally total;
  for (const Tally& tally : tallies) total.add(tally);
  for (const std::string& text : complaints) fmt::print("{}", text);
  fmt::print("seed {}, epsilon {} mm: {} models, {} layers\n", seed, epsilon, total.models, total.layers);
  fmt::print("{:>8} equal in number, kind and nesting, and the truth too\n", total.equal);
  fmt::print("{:>8} the dense method is wrong where solids meet, as the true union shows\n", total.unions);
  fmt::print("{:>8} it is wrong where contours are nearer or smaller than {} cells, as the truth shows\n",
             total.unresolved, kUnresolvedCells);
  fmt::print("{:>8} it takes thick lines of cells for contours, as the truth shows\n", total.thick);
  fmt::print(
      "{:>8} a solid or a hole lies wholly within another solid: by lamina's rule of parity a cavity\n",
      total.swallowed);
  fmt::print("{:>8} solids overlap, or hold one another, by less than the chords' tolerance, or fail to\n",
             total.grazing);
  fmt::print("{:>8} equal, the area of the dense method off by more than a cell, as the truth shows\n",
             total.dense_areas);
  fmt::print("{:>8} not explained\n{:>8} equal, but of different area\n", total.wrong, total.areas);
  return total.wrong + total.areas == 0 && total.layers > 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return lamina::tools::run_measurement(run, argc, argv);
}
