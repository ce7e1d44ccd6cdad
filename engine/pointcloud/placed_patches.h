#pragma once

#include <vector>

#include "engine/nurbs/bezier.h"
#include "engine/pointcloud/trim_region.h"

namespace lamina::engine {

/// A Bezier patch, its place in the parameter plane of its surface, and how the trim curves lie to it.
struct PlacedPatch {
  BezierPatch patch;
  Vector2 low;
  Vector2 high;
  TrimPlace place = TrimPlace::kInside;
};

/// The patches of a surface that are not wholly outside of its trim loops. `region` is the surface's own,
/// null when it is not trimmed.
std::vector<PlacedPatch> placed_patches(const Surface& surface, const TrimRegion* region);

}  // namespace lamina::engine
