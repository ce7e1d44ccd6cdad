#include <cmath>

#include <fmt/format.h>

#include "engine/import/iges/cubic_fit.h"
#include "engine/import/iges/entity_reader.h"
#include "engine/import/iges/entity_readers.h"
#include "engine/import/iges/parameter_record.h"

namespace lamina::engine {
namespace {

constexpr std::size_t kMostPoints = 65536;

/// Normal of length 1; where a pole leaves none, that of a point a little farther inside.
Vector3 unit_normal(const NurbsSurface& surface, double u, double v) {
  const Vector2 middle(0.5 * (surface.first_u() + surface.last_u()),
                       0.5 * (surface.first_v() + surface.last_v()));
  for (const double part : {0.0, 1e-6, 1e-4, 1e-2}) {
    const SurfaceDerivatives d =
        evaluate_derivatives(surface, u + part * (middle.x() - u), v + part * (middle.y() - v));
    const Vector3 normal = d.du.cross(d.dv);
    if (normal.norm() > 1e-9 * (d.du.squaredNorm() + d.dv.squaredNorm())) return normal.normalized();
  }
  return Vector3::Zero();
}

}  // namespace

/// IGES 5.3, section 4.33: a surface moved along its normals by a distance, to the side that a vector at the
/// middle of its domain shows. Approximated, with the parameters of the surface.
NurbsSurface read_offset_surface_140(ParameterRecord& record, EntityReader& reader) {
  const Vector3 indicator = record.vector("offset indicator");
  const double distance = record.real("distance");
  const std::size_t base = reader.child(record, "surface");
  const NurbsSurface surface = reader.surface_of_face(record, base, {});
  const Vector3 in_the_middle = unit_normal(surface, 0.5 * (surface.first_u() + surface.last_u()),
                                            0.5 * (surface.first_v() + surface.last_v()));
  const double signed_distance = in_the_middle.dot(indicator) < 0.0 ? -distance : distance;
  const std::vector<double> us = break_points(surface.knots_u, surface.degree_u);
  const std::vector<double> vs = break_points(surface.knots_v, surface.degree_v);
  const double size = control_box(surface.net).diagonal().norm() + std::abs(distance);
  const auto point = [&](double u, double v) {
    return Vector3(evaluate(surface, u, v) + signed_distance * unit_normal(surface, u, v));
  };
  const CubicFit<NurbsSurface> fit = fit_bicubics(point, us, vs, reader.trim_tolerance(size), kMostPoints);
  record.note(Tolerance::kOffsetApproximated, fmt::format("within {:.2g} file units", fit.error));
  return fit.fitted;
}

}  // namespace lamina::engine
