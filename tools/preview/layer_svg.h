#pragma once

#include <string>

#include "engine/layer.h"

namespace lamina::tools {

/// A picture of one layer's contours: what is solid by parity lightly filled, closed contours black, open
/// ones red, planar ones filled brown, touch points blue; touch contours dashed. `frame` in mm is the part of
/// the plane that is shown.
std::string layer_svg(const engine::Layer& layer, const engine::Box2& frame);

}  // namespace lamina::tools
