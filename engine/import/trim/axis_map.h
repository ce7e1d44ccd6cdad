#pragma once

#include <vector>

#include "engine/nurbs/surface.h"

namespace lamina::engine {

/// How a parameter as CAD formats define it (an angle on arcs) becomes the NURBS parameter of the same point:
/// both agree at the knots, and between them but for arcs.
class AxisMap {
 public:
  /// The same everywhere.
  AxisMap() = default;

  /// By the weights of a direction's Bezier pieces of degree 2: w, w cos(a), w is an arc of angle 2 a.
  AxisMap(const Knots& knots, int degree, const std::vector<double>& weights);

  bool is_identity() const { return spans_.empty(); }
  double operator()(double parameter) const;

 private:
  struct Span {
    double first = 0.0;
    double last = 1.0;
    double half_angle = 0.0;  ///< 0 where both parameters agree
  };
  std::vector<Span> spans_;
};

/// The same for both parameters of a surface.
struct ParameterMap {
  AxisMap u;
  AxisMap v;

  bool is_identity() const { return u.is_identity() && v.is_identity(); }
  Vector2 operator()(const Vector2& at) const { return {u(at.x()), v(at.y())}; }
};

/// The maps of a surface whose arcs are all meant by their angles.
AxisMap angle_map_u(const NurbsSurface& surface);
AxisMap angle_map_v(const NurbsSurface& surface);

}  // namespace lamina::engine
