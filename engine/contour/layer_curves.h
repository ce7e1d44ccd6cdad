#pragma once

#include "engine/contour/layer_chains.h"
#include "engine/layer.h"
#include "engine/slice_options.h"

namespace lamina::engine {

/// Lines, arcs and splines through the nodes of a layer's chains, within `fit_part` of epsilon of the
/// section. Index and plane of the result are not set; its report holds what was counted here.
Layer make_curves(const LayerChains& chains, const SliceOptions& options);

}  // namespace lamina::engine
