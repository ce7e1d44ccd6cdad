#pragma once

#include "engine/nurbs/bezier.h"

namespace lamina::tools {

/// A point of a patch and its first derivatives.
struct PatchPoint {
  engine::Vector3 point;
  engine::Vector3 du;
  engine::Vector3 dv;
};

/// Bernstein sums, point only.
engine::Vector3 evaluate_point(const engine::BezierPatch& patch, double u, double v);

/// Bernstein sums and the quotient rule (The NURBS Book, equations 1.28 and 4.20), apart from the engine's
/// own: what is measured must not measure itself.
PatchPoint evaluate_with_derivatives(const engine::BezierPatch& patch, double u, double v);

}  // namespace lamina::tools
