#pragma once

#include <vector>

#include "engine/model.h"
#include "engine/nurbs/bezier.h"

namespace lamina::reference {

using namespace engine;

struct DecomposeOptions {
  double layer_thickness = 0.2;  ///< lambda, mm
  int band_constant = 3;         ///< c: layers that a patch should span on average; greater than one
};

/// Length of the longest row (along u) and column (along v) of control points, mm.
struct Extent {
  double u = 0.0;
  double v = 0.0;
};

Extent net_extent(const ControlNet& net);

/// Approximate extents of a surface: those of its net after one refinement, which inserts a knot in the
/// middle of every non-zero span (dissertation p. 122).
Extent surface_extent(const NurbsSurface& surface);

/// Knots to insert into each non-zero span so that its Bezier patch comes out near the size of the band:
/// floor(extent / (spans * band) + 1/2) (dissertation p. 122).
int inserted_knots_per_span(double extent, std::size_t spans, double band);

/// Cuts every surface into Bezier patches of about the size of the band B = c * lambda. Exact: the patches
/// are the surface. Throws std::invalid_argument when an option is out of its range.
std::vector<BezierPatch> decompose(const Model& model, const DecomposeOptions& options);

}  // namespace lamina::reference
