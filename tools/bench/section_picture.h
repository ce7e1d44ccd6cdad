#pragma once

#include <string>
#include <vector>

#include "engine/geometry/polygon.h"

namespace lamina::tools {

/// Two sections on top of each other as SVG: lamina's region filled, the other's lines in red, every line's
/// ends as dots.
std::string section_picture(const engine::Region& ours, const std::vector<engine::Polyline>& theirs,
                            const std::string& title);

}  // namespace lamina::tools
