#include "engine/import/iges/plane_patch.h"

#include "engine/nurbs/curve.h"

namespace lamina::engine {

NurbsSurface plane_patch(const Vector3& origin, const Vector3& normal, const std::vector<Vector3>& cover) {
  const Vector3 n = normal.normalized();
  const Vector3 x = n.unitOrthogonal();
  const Vector3 y = n.cross(x);
  const Vector3 foot = origin.dot(n) * n;
  Box2 box;
  for (const Vector3& point : cover) box.extend(Vector2(x.dot(point), y.dot(point)));
  if (box.isEmpty()) box.extend(Vector2(0.0, 0.0));
  const double room = 0.01 * box.diagonal().norm() + (box.diagonal().norm() > 0.0 ? 0.0 : 1.0);
  const Vector2 low = box.min().array() - room;
  const Vector2 high = box.max().array() + room;
  NurbsSurface surface;
  surface.knots_u = {low.x(), low.x(), high.x(), high.x()};
  surface.knots_v = {low.y(), low.y(), high.y(), high.y()};
  surface.net.count_u = 2;
  surface.net.count_v = 2;
  for (const double u : {low.x(), high.x()}) {
    for (const double v : {low.y(), high.y()})
      surface.net.points.push_back(homogeneous(foot + u * x + v * y));
  }
  return surface;
}

}  // namespace lamina::engine
