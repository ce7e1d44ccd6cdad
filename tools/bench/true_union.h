#pragma once

#include <optional>
#include <vector>

#include "engine/geometry/polygon.h"
#include "engine/model.h"
#include "tools/bench/true_section.h"

namespace lamina::tools {

/// Closed loops from the pieces of a section, their ends joined; nothing where an end has no partner, which
/// means that the lines were too far apart for the shape.
std::optional<std::vector<engine::Loop>> loops_of(const std::vector<SectionPiece>& pieces);

/// What each part fills at height z, by parity of its true section. The engine has no part in it. Nothing
/// where no spacing down to a hundredth of a millimetre gives closed loops.
std::optional<std::vector<engine::Region>> true_regions(const std::vector<engine::Model>& parts, double z,
                                                        double spacing);

/// The union of the regions, by Clipper. Islands and holes narrower than `narrowest` (mm, mean width) are
/// left out.
engine::Region true_union(const std::vector<engine::Region>& regions, double narrowest);

/// The same but for regions that lie wholly inside another one, whose outlines do not meet: those count by
/// parity, as cavities.
engine::Region true_nesting(const std::vector<engine::Region>& regions, double narrowest);

}  // namespace lamina::tools
