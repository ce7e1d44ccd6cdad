#pragma once

#include "engine/model.h"

namespace lamina::engine {

/// Box around the surfaces themselves, as far as their trim loops leave them, the triangles and the
/// points: too large or too small by at most a micrometre on any side.
Box3 model_bounds(const Model& model);

}  // namespace lamina::engine
