#pragma once

#include "engine/layer.h"
#include "tests/reference/layer.h"

namespace lamina::reference {

/// The dense method's layer in the engine's form, to compare the two: every curve one spline.
engine::Layer as_engine_layer(const Layer& layer);

}  // namespace lamina::reference
