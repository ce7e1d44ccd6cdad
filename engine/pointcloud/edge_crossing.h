#pragma once

#include <optional>

#include "engine/pointcloud/front_state.h"
#include "engine/pointcloud/patch_point.h"
#include "engine/pointcloud/trim_region.h"

namespace lamina::engine {

/// Point of a trimmed surface, with the derivatives along its own parameters. Taken on the patch where the
/// place lies in it, otherwise on the surface.
PatchPoint surface_point(const FrontPatch& patch, const Vector2& parameters);

/// Where a trim curve of the patch's surface passes the plane at height z, looked for from parameter `guess`
/// on, between two of its samples or next to them: on the curve, on the surface and within 1e-12 mm of the
/// plane. Nothing where it does not pass there.
std::optional<PatchPoint> edge_crossing(const FrontPatch& patch, const BezierChain& curve, double guess,
                                        const EdgeSample& first, const EdgeSample& last, double z);

}  // namespace lamina::engine
