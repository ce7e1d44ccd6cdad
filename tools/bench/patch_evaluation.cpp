#include "tools/bench/patch_evaluation.h"

#include "engine/pointcloud/patch_point.h"

namespace lamina::tools {
namespace {

struct Bernstein {
  double value[engine::kHighestPatchDegree + 1];
  double slope[engine::kHighestPatchDegree + 1];

  Bernstein(int degree, double t) {
    // The triangle of de Casteljau on the basis; its last row but one gives the derivatives.
    value[0] = 1.0;
    slope[0] = 0.0;
    for (int n = 1; n <= degree; ++n) {
      if (n == degree) {
        for (int k = 0; k <= n; ++k) {
          slope[k] = n * ((k > 0 ? value[k - 1] : 0.0) - (k < n ? value[k] : 0.0));
        }
      }
      value[n] = t * value[n - 1];
      for (int k = n - 1; k > 0; --k) value[k] = (1.0 - t) * value[k] + t * value[k - 1];
      value[0] *= 1.0 - t;
    }
  }
};

}  // namespace

engine::Vector3 evaluate_point(const engine::BezierPatch& patch, double u, double v) {
  const Bernstein along_u(patch.degree_u, u);
  const Bernstein along_v(patch.degree_v, v);
  engine::Vector4 point = engine::Vector4::Zero();
  const engine::Vector4* control = patch.net.points.data();
  for (int i = 0; i <= patch.degree_u; ++i) {
    engine::Vector4 row = engine::Vector4::Zero();
    for (int j = 0; j <= patch.degree_v; ++j, ++control) row += along_v.value[j] * *control;
    point += along_u.value[i] * row;
  }
  return point.head<3>() / point.w();
}

PatchPoint evaluate_with_derivatives(const engine::BezierPatch& patch, double u, double v) {
  const Bernstein along_u(patch.degree_u, u);
  const Bernstein along_v(patch.degree_v, v);
  engine::Vector4 point = engine::Vector4::Zero();
  engine::Vector4 du = engine::Vector4::Zero();
  engine::Vector4 dv = engine::Vector4::Zero();
  const engine::Vector4* control = patch.net.points.data();
  for (int i = 0; i <= patch.degree_u; ++i) {
    engine::Vector4 row = engine::Vector4::Zero();
    engine::Vector4 row_slope = engine::Vector4::Zero();
    for (int j = 0; j <= patch.degree_v; ++j, ++control) {
      row += along_v.value[j] * *control;
      row_slope += along_v.slope[j] * *control;
    }
    point += along_u.value[i] * row;
    du += along_u.slope[i] * row;
    dv += along_u.value[i] * row_slope;
  }
  const engine::Vector3 cartesian = point.head<3>() / point.w();
  return {cartesian, (du.head<3>() - du.w() * cartesian) / point.w(),
          (dv.head<3>() - dv.w() * cartesian) / point.w()};
}

}  // namespace lamina::tools
