#pragma once

#include <optional>
#include <vector>

#include "engine/import/trim/parameter_loop.h"

namespace lamina::engine {

/// Loops that go once round a surface closed in u become loops that bound an area: two and two are cut along
/// the seam and joined there, one that stays alone is joined to the border of the domain that it faces, its
/// left side being inside. Other loops stay as they are. Nothing where a loop turns more than once.
std::optional<std::vector<ParameterLoop>> without_turns_in_u(const NurbsSurface& surface,
                                                             const SurfaceTopology& topology,
                                                             std::vector<ParameterLoop> loops);

}  // namespace lamina::engine
