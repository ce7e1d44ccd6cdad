#pragma once

#include <vector>

#include "engine/layer.h"
#include "engine/slice_options.h"

namespace lamina::engine {

/// Height of the plane that cuts a layer, mm.
double plane_height(double bottom, double top, SlicePosition position);

/// The layers of a model that reaches from z_min to z_max, bottom first: ceil(height / lambda) of them, each
/// full thickness (dissertation p. 118), less those whose plane lies above the model. A height that is a
/// whole number of layers but for rounding counts as whole. Throws std::invalid_argument when a thickness is
/// not positive or there would be more than ten million layers.
std::vector<SlicePlane> make_slicing_planes(double z_min, double z_max, const SlicingPlanesOptions& options);

}  // namespace lamina::engine
