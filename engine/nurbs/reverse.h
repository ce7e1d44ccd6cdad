#pragma once

#include "engine/nurbs/curve.h"

namespace lamina::engine {

/// The same points on the same domain, run through backwards.
NurbsCurve reversed(const NurbsCurve& curve);

}  // namespace lamina::engine
