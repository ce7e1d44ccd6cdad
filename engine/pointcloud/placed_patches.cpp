#include "engine/pointcloud/placed_patches.h"

#include <utility>

#include "engine/geometry/bspline_basis.h"

namespace lamina::engine {

std::vector<PlacedPatch> placed_patches(const Surface& surface, const TrimRegion* region) {
  const NurbsSurface& nurbs = surface.nurbs;
  const std::vector<double> breaks_u = break_points(nurbs.knots_u, nurbs.degree_u);
  const std::vector<double> breaks_v = break_points(nurbs.knots_v, nurbs.degree_v);
  const std::size_t spans_v = breaks_v.size() - 1;
  std::vector<PlacedPatch> placed;
  std::size_t k = 0;
  for (BezierPatch& patch : bezier_patches(nurbs)) {
    const std::size_t u = k / spans_v;
    const std::size_t v = k % spans_v;
    ++k;
    const Vector2 low(breaks_u[u], breaks_v[v]);
    const Vector2 high(breaks_u[u + 1], breaks_v[v + 1]);
    const TrimPlace place = region == nullptr ? TrimPlace::kInside : region->chords().place_of(low, high);
    if (place != TrimPlace::kOutside) placed.push_back({std::move(patch), low, high, place});
  }
  return placed;
}

}  // namespace lamina::engine
