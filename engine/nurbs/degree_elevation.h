#pragma once

#include "engine/nurbs/bezier_chain.h"

namespace lamina::engine {

/// The same curve with the degree raised to `degree`, which is not below the chain's own. Exact up to
/// rounding, on homogeneous points (The NURBS Book, equation 5.36).
BezierChain elevated(const BezierChain& chain, int degree);

}  // namespace lamina::engine
