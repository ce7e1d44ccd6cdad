#include "engine/model_bounds.h"

#include "engine/nurbs/bounds.h"
#include "engine/pointcloud/placed_patches.h"

namespace lamina::engine {
namespace {

constexpr double kTolerance = 1e-3;
constexpr int kDeepest = 20;

void extend_by_corners(Box3& box, const NurbsSurface& nurbs) {
  for (const double u : {nurbs.first_u(), nurbs.last_u()}) {
    for (const double v : {nurbs.first_v(), nurbs.last_v()}) box.extend(evaluate(nurbs, u, v));
  }
}

/// Extends the box by a trimmed surface: patches that could reach beyond it are halved until they lie inside
/// the loops or outside, or are so small that the trim curves, which the box contains, stand for them.
void extend_by_trimmed(Box3& known, const Surface& surface) {
  const TrimRegion region(surface, 0);
  for (const auto& edge : region.samples()) {
    for (const EdgeSample& sample : edge) known.extend(sample.position);
  }
  const Vector3 margin = Vector3::Constant(kTolerance);
  const auto visit = [&](auto&& self, const PlacedPatch& placed, int depth) -> void {
    const Box3 reached(known.min() - margin, known.max() + margin);
    if (reached.contains(control_box(placed.patch.net))) return;
    const TrimPlace place = region.chords().place_of(placed.low, placed.high);
    if (place == TrimPlace::kOutside) return;
    if (place == TrimPlace::kInside) {
      known = surface_bounds({placed.patch}, kTolerance, known);
      return;
    }
    if (depth == kDeepest) return;
    const Vector2 middle = 0.5 * (placed.low + placed.high);
    if (depth % 2 == 0) {
      const auto [low, high] = halves_in_u(placed.patch);
      self(self, {low, placed.low, {middle.x(), placed.high.y()}, placed.place}, depth + 1);
      self(self, {high, {middle.x(), placed.low.y()}, placed.high, placed.place}, depth + 1);
    } else {
      const auto [low, high] = halves_in_v(placed.patch);
      self(self, {low, placed.low, {placed.high.x(), middle.y()}, placed.place}, depth + 1);
      self(self, {high, {placed.low.x(), middle.y()}, placed.high, placed.place}, depth + 1);
    }
  };
  for (const PlacedPatch& placed : placed_patches(surface, &region)) visit(visit, placed, 0);
}

}  // namespace

Box3 model_bounds(const Model& model) {
  Box3 known;
  for (const TriangleMesh& mesh : model.meshes) known.extend(bounds(mesh));
  for (const PointCloud& cloud : model.clouds) known.extend(bounds(cloud));
  for (const Surface& surface : model.surfaces) {
    if (surface.trim.empty()) extend_by_corners(known, surface.nurbs);
  }
  for (const Surface& surface : model.surfaces) {
    if (!surface.trim.empty()) {
      extend_by_trimmed(known, surface);
    } else if (!known.contains(control_box(surface.nurbs.net))) {
      known = surface_bounds(bezier_patches(surface.nurbs), kTolerance, known);
    }
  }
  return known;
}

}  // namespace lamina::engine
