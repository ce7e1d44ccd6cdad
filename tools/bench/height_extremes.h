#pragma once

#include <vector>

#include "engine/nurbs/bezier.h"

namespace lamina::tools {

/// Parameters strictly between 0 and 1 of lines through a patch, ascending.
struct ParameterLines {
  std::vector<double> us;
  std::vector<double> vs;
};

/// Lines through the summits and pits of a patch, and through those of its four sides: however small the loop
/// is in which a plane cuts one off, they cross it. Found from a grid that is finer than a polynomial of the
/// patch's degree can wave, by compass search (Kolda, Lewis and Torczon, SIAM Review 45, 2003).
ParameterLines lines_through_extremes(const engine::BezierPatch& patch);

}  // namespace lamina::tools
