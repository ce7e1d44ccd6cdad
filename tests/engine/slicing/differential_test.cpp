// The sparse engine against the dense one on the corpus: number, kind and nesting of contours, and areas
// within what a half cell allows. Random solids are compared by tools/bench/differential.

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "engine/import/read_model.h"
#include "engine/model_bounds.h"
#include "engine/slicer.h"
#include "engine/slicing_planes.h"
#include "tests/engine/slicing/sliced_layers.h"
#include "tests/reference/as_engine_layer.h"
#include "tests/reference/reference_slicer.h"
#include "tests/support/contour_measure.h"
#include "tests/support/corpus.h"
#include "tools/bench/contour_kinds.h"

namespace lamina::tests {
namespace {

using engine::Layer;
using engine::Loop;
using engine::Model;
using engine::Vector2;

/// Where the engines may differ, and why.
struct Comparison {
  std::size_t layers = 0;
  std::size_t equal = 0;
  /// The dense engine sees contours that come nearer than two cells to each other as one, and those smaller
  /// than two cells as a point or a line.
  std::size_t below_resolution = 0;
  /// Contours that overlap or touch: the dense engine keeps the outside of what is connected and loses the
  /// holes in it.
  std::size_t met = 0;
  /// Open contours that are no touch: a closed solid has none. The dense engine makes them from the thick
  /// lines of strong cells where a surface leans on the plane.
  std::size_t spurs = 0;
  /// Loops of the dense engine narrower than three cells that lie along another one: of the same thick lines.
  std::size_t slivers = 0;
  std::size_t unexplained = 0;
};

bool smaller_than(const Loop& loop, double size) {
  engine::Box2 box;
  for (const Vector2& point : loop) box.extend(point);
  return box.sizes().minCoeff() < size;
}

/// Whether two loops, or one loop and itself across an angle of its outline, come nearer than `distance`.
bool loops_come_near(const std::vector<Loop>& loops, double distance) {
  for (const Loop& loop : loops) {
    if (smaller_than(loop, 2.0 * distance)) return true;
    for (const Loop& other : loops) {
      if (&other == &loop) continue;
      for (const Vector2& point : loop) {
        if (distance_to_loops(point, {other}) < distance) return true;
      }
    }
    // Two places far apart along the loop but near each other.
    const double whole = engine::perimeter(loop);
    std::vector<double> reached{0.0};
    for (std::size_t k = 1; k < loop.size(); ++k)
      reached.push_back(reached.back() + (loop[k] - loop[k - 1]).norm());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      for (std::size_t j = i + 1; j < loop.size(); ++j) {
        const double along = std::min(reached[j] - reached[i], whole - (reached[j] - reached[i]));
        const double straight = (loop[i] - loop[j]).norm();
        if (straight < distance && along > 3.0 * std::max(straight, distance)) return true;
      }
    }
  }
  return false;
}

std::size_t wide_loops(const std::vector<Loop>& loops, double width) {
  return static_cast<std::size_t>(std::count_if(loops.begin(), loops.end(), [&](const Loop& loop) {
    return 2.0 * std::abs(engine::signed_area(loop)) >= width * engine::perimeter(loop);
  }));
}

enum class Boundary { kClosed, kMayBeOpen };

void compare(const Model& model, Boundary boundary, const std::vector<engine::SlicePlane>& planes,
             double epsilon, Comparison& result) {
  engine::SliceOptions options;
  options.epsilon = epsilon;
  engine::Slicer slicer(model, planes, options);
  reference::SliceOptions dense_options;
  dense_options.layer_thickness = 0.5;
  dense_options.epsilon = epsilon;
  reference::ReferenceSlicer dense(model, planes, dense_options);
  while (const auto fast = slicer.next()) {
    const auto dense_layer = dense.next();
    REQUIRE(dense_layer);
    const Layer slow = reference::as_engine_layer(*dense_layer);
    ++result.layers;
    const std::vector<Loop> fast_loops = closed_loops(*fast, 0.05 * epsilon);
    const std::vector<Loop> slow_loops = closed_loops(slow, 0.05 * epsilon);
    const tools::ContourKinds f = tools::kinds_of(*fast, 0.05 * epsilon);
    const tools::ContourKinds s = tools::kinds_of(slow, 0.05 * epsilon);
    if (boundary == Boundary::kClosed) CHECK(f.open == 0);
    if (f == s) {
      ++result.equal;
      // Half a cell along the contour, up to a whole one where the surface leans on the plane.
      const double allowed = epsilon * perimeter_of(fast_loops) + 4.0 * epsilon * epsilon;
      CAPTURE(model.name, fast->plane.z);
      CHECK(std::abs(parity_area(fast_loops) - parity_area(slow_loops)) <= allowed);
    } else if (fast->report.meetings > 0) {
      ++result.met;
    } else if (loops_come_near(fast_loops, 3.0 * epsilon) || fast->report.close_places > 0) {
      ++result.below_resolution;
    } else if (boundary == Boundary::kClosed && s.open > 0) {
      ++result.spurs;
    } else if (s.open == f.open &&
               wide_loops(fast_loops, 3.0 * epsilon) == wide_loops(slow_loops, 3.0 * epsilon) &&
               greatest_difference(slow_loops, fast_loops) < 6.0 * epsilon) {
      ++result.slivers;
    } else {
      ++result.unexplained;
      WARN(model.name << " at z = " << fast->plane.z << ": sparse " << f.depths.size() << " closed, "
                      << f.touching << " touching, " << f.open << " open, " << f.planar << " planar, "
                      << f.points << " points; dense " << s.depths.size() << ", " << s.touching << ", "
                      << s.open << ", " << s.planar << ", " << s.points << ", areas "
                      << parity_area(fast_loops) << " and " << parity_area(slow_loops));
    }
  }
}

std::vector<engine::SlicePlane> planes_through(const Model& model, std::size_t count) {
  const engine::Box3 box = engine::model_bounds(model);
  std::vector<engine::SlicePlane> planes;
  for (std::size_t k = 0; k < count; ++k) {
    const double z =
        box.min().z() + box.sizes().z() * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    planes.push_back({z, z, z});
  }
  return planes;
}

TEST_CASE("corpus: both engines see the same contours", "[slicing][differential]") {
  if (!corpus_present()) {
    WARN("the model corpus is missing: skipped");
    return;
  }
  Comparison result;
  for (const char* name :
       {"analytic/box_hole_lying.igs", "analytic/sphere_cavity.igs", "analytic/spheres_overlap.igs",
        "analytic/torus_standing.igs", "analytic/tube_annulus.igs", "seed/initials_WEO.igs",
        "seed/trefoil_swept.igs", "freeform/teacup26.igs"}) {
    const Model model = engine::read_model(corpus_file(name)).model;
    compare(model, Boundary::kMayBeOpen, planes_through(model, 4), 0.1, result);
  }
  CAPTURE(result.layers, result.equal, result.met, result.below_resolution, result.spurs, result.slivers);
  CHECK(result.unexplained == 0);
  CHECK(result.equal >= result.layers * 9 / 10);
}

}  // namespace
}  // namespace lamina::tests
