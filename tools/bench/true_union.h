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

/// What each part fills at height z, or 1e-5 mm beside it where the section at z does not close, by parity of
/// its true section. The engine has no part in it. Nothing where no spacing down to a hundredth of a
/// millimetre gives closed loops.
std::optional<std::vector<engine::Region>> true_regions(const std::vector<engine::Model>& parts, double z,
                                                        double spacing);

/// The union of the regions, by Clipper. Islands and holes narrower than `narrowest` (mm, mean width) are
/// left out.
engine::Region true_union(const std::vector<engine::Region>& regions, double narrowest);

/// The same but for outlines that lie wholly inside another region and meet none of its outlines: those count
/// by parity. A solid within another is a cavity, a hole that another solid covers stays a hole.
engine::Region true_nesting(const std::vector<engine::Region>& regions, double narrowest);

}  // namespace lamina::tools
