#pragma once

#include <optional>
#include <vector>

#include "engine/import/trim/parameter_loop.h"
#include "engine/model.h"

namespace lamina::engine {

/// A surface and the loops that cut it, as Model wants them.
struct TrimmedPatch {
  NurbsSurface nurbs;
  std::vector<TrimLoop> trim;
};

/// Lays loops out inside the domain of their surface: loops that go round a closed surface are cut and joined
/// to such that bound an area, the seam is moved away from loops that cross it, and each loop is turned as
/// its nesting asks (outer counter-clockwise, holes clockwise). The surface is cut down to the box of the
/// loops; where that leaves nothing to trim, there are no loops. With `whole_outside` the border of the
/// domain is one more loop. Nothing where the loops cannot be laid out: they enclose no area, or turn about
/// the surface more than once.
std::optional<TrimmedPatch> trimmed_patch(const NurbsSurface& surface, const SurfaceTopology& topology,
                                          std::vector<ParameterLoop> loops, bool whole_outside,
                                          double tolerance);

}  // namespace lamina::engine
