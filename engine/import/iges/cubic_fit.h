#pragma once

#include <functional>
#include <vector>

#include "engine/nurbs/curve.h"
#include "engine/nurbs/surface.h"

namespace lamina::engine {

/// A fit and how far it is off at the points where it was compared.
template <typename Fitted>
struct CubicFit {
  Fitted fitted;
  double error = 0.0;
};

/// Cubics through four points of each piece between `breaks`; pieces are halved, all of them, until the fit
/// is within `tolerance` between these points, or has `most_points` control points. Same parameter.
CubicFit<NurbsCurve> fit_cubics(const std::function<Vector3(double)>& point, std::vector<double> breaks,
                                double tolerance, std::size_t most_points);

/// The same for a surface, bicubic; the direction that is farther off is halved.
CubicFit<NurbsSurface> fit_bicubics(const std::function<Vector3(double, double)>& point,
                                    std::vector<double> breaks_u, std::vector<double> breaks_v,
                                    double tolerance, std::size_t most_points);

}  // namespace lamina::engine
