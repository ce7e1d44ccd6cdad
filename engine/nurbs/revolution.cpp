#include "engine/nurbs/revolution.h"

#include <cmath>
#include <vector>

#include "engine/nurbs/arc.h"

namespace lamina::engine {

NurbsSurface surface_of_revolution(const NurbsCurve& generatrix, const Vector3& axis_point,
                                   const Vector3& axis_direction, double first, double last) {
  const Vector3 axis = axis_direction.normalized();
  // Every control point moves on the same arc, up to its radius.
  const NurbsCurve arc = ellipse_arc(Vector3::Zero(), Vector3::UnitX(), Vector3::UnitY(), first, last);

  NurbsSurface surface;
  surface.degree_u = generatrix.degree;
  surface.knots_u = generatrix.knots;
  surface.degree_v = arc.degree;
  surface.knots_v = arc.knots;
  surface.net.count_u = generatrix.control_points.size();
  surface.net.count_v = arc.control_points.size();
  surface.net.points.reserve(surface.net.count_u * surface.net.count_v);
  for (const Vector4& control_point : generatrix.control_points) {
    const Vector3 point = cartesian(control_point);
    const Vector3 foot = axis_point + axis.dot(point - axis_point) * axis;
    const Vector3 x = point - foot;
    const Vector3 y = axis.cross(x);
    for (const Vector4& on_arc : arc.control_points) {
      const Vector3 unit = cartesian(on_arc);
      surface.net.points.push_back(
          homogeneous(foot + unit.x() * x + unit.y() * y, control_point.w() * on_arc.w()));
    }
  }
  return surface;
}

}  // namespace lamina::engine
