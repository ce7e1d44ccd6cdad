#pragma once

#include "engine/nurbs/curve.h"
#include "engine/nurbs/surface.h"

namespace lamina::engine {

/// The piece of the curve on [first, last], inside its domain and of positive length, as a clamped curve with
/// the same parameters. Exact up to rounding.
NurbsCurve restricted(const NurbsCurve& curve, double first, double last);

/// The piece of the surface on [first_u, last_u] x [first_v, last_v], clamped, with the same parameters.
NurbsSurface restricted(const NurbsSurface& surface, double first_u, double last_u, double first_v,
                        double last_v);

}  // namespace lamina::engine
