#pragma once

#include <utility>
#include <vector>

#include "engine/geometry/vector.h"
#include "engine/nurbs/surface.h"

namespace lamina::engine {

/// A rational Bezier patch on [0, 1] x [0, 1], mm. Invariant: net.count_u == degree_u + 1, the same for v.
struct BezierPatch {
  int degree_u = 1;
  int degree_v = 1;
  ControlNet net;
};

/// Point at (u, v), by Bernstein sums (The NURBS Book, equation 1.28).
Vector3 evaluate(const BezierPatch& patch, double u, double v);

/// The patches that a clamped surface is made of, one per pair of non-zero knot spans, u the slower index:
/// knots are inserted to full multiplicity, then the net is cut. Exact up to rounding (The NURBS Book, A5.7).
std::vector<BezierPatch> bezier_patches(const NurbsSurface& surface);

/// The two halves of a patch at u = 1/2, or at v = 1/2 (de Casteljau; The NURBS Book, A1.5).
std::pair<BezierPatch, BezierPatch> halves_in_u(const BezierPatch& patch);
std::pair<BezierPatch, BezierPatch> halves_in_v(const BezierPatch& patch);

}  // namespace lamina::engine
