#pragma once

#include <vector>

#include "engine/nurbs/curve.h"
#include "engine/nurbs/surface.h"

namespace lamina::engine {

/// The same curve with the knots of `inserted` (ascending, inside the domain; repeats allowed up to full
/// multiplicity) added to its knot vector. Exact up to rounding. The NURBS Book, section 5.3, A5.4.
NurbsCurve insert_knots(const NurbsCurve& curve, const std::vector<double>& inserted);

/// The same surface with knots inserted in the u, then the v direction.
NurbsSurface insert_knots(const NurbsSurface& surface, const std::vector<double>& inserted_u,
                          const std::vector<double>& inserted_v);

/// The same curve on the same domain, with end knots of multiplicity degree + 1: periodic and unclamped knot
/// vectors become clamped ones.
NurbsCurve clamped(const NurbsCurve& curve);

/// The same for both directions of a surface.
NurbsSurface clamped(const NurbsSurface& surface);

}  // namespace lamina::engine
