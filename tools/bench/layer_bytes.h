#pragma once

#include <string>

#include "engine/layer.h"

namespace lamina::tools {

/// Everything that a layer says but its times, bit for bit: equal layers have equal bytes.
std::string bytes_of(const engine::Layer& layer);

}  // namespace lamina::tools
