#pragma once

#include <vector>

#include "engine/nurbs/curve.h"

namespace lamina::engine {

/// One curve that runs through all pieces in turn (at least one). Each keeps its own length of parameter; the
/// domain starts at 0. Neighbours are joined in the middle between the end of one and the start of the next,
/// so pieces that meet are reproduced exactly, and a gap moves each by half of it. The degree is the highest
/// among the pieces.
NurbsCurve joined(const std::vector<NurbsCurve>& pieces);

}  // namespace lamina::engine
