#pragma once

#include "engine/model.h"

namespace lamina::engine {

/// Integrals over the part of a surface that counts, n being du x dv of its parameters.
struct SurfaceIntegrals {
  double area = 0.0;                      ///< mm^2
  Vector3 vector_area = Vector3::Zero();  ///< of n, mm^2: zero for a closed surface
  double flux = 0.0;                      ///< of a third of position . n, mm^3
};

/// By Green's theorem: along the trim loops, of integrals over u, each by Gauss's rule of five points on
/// pieces of knot spans. Exact up to rounding for planes; about 1e-6 of the area otherwise.
SurfaceIntegrals surface_integrals(const Surface& surface);

}  // namespace lamina::engine
