#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "engine/geometry/polygon.h"
#include "engine/model.h"

namespace lamina::tests {

/// What a horizontal plane and a solid have in common, by closed form.
struct Section {
  double area = 0.0;       ///< mm^2
  double perimeter = 0.0;  ///< of all curves, mm
  std::size_t curves = 0;  ///< closed curves
  /// Sum over the curves of the total turning of the tangent, rad: 2 pi for each convex one.
  double turning = 0.0;
  /// Largest |z component| of the surface's unit normal along the curves: 0 on upright walls, near 1 where it
  /// grazes.
  double normal_z = 0.0;
  /// Distance of a point of the plane from the nearest curve, mm.
  std::function<double(const engine::Vector2&)> distance;
  /// Points on every curve, at most the given step apart.
  std::function<std::vector<engine::Vector2>(double)> points;
};

/// A solid bounded by exact NURBS surfaces, and what is known about it without slicing it.
struct AnalyticModel {
  engine::Model model;
  engine::Box3 box;                          ///< of the solid itself
  double volume = 0.0;                       ///< mm^3
  std::function<Section(double z)> section;  ///< at a height strictly inside that is no touch
};

/// Closed curves of the plane from which sections are put together.
Section circle_section(const engine::Vector2& centre, double radius);
Section rectangle_section(const engine::Vector2& low, const engine::Vector2& high);
/// `outer` with the disjoint `hole` cut out.
Section with_hole(const Section& outer, const Section& hole);
/// Two disjoint sections.
Section beside(const Section& a, const Section& b);
/// Inside of closed chains that do not cross, filled by parity; the distance is that to the chains.
Section polyline_section(const std::vector<engine::Loop>& loops);

AnalyticModel sphere(const engine::Vector3& centre, double radius);
/// Along z, standing on `base`.
AnalyticModel upright_cylinder(const engine::Vector3& base, double radius, double height);
/// Along x, from `start`.
AnalyticModel lying_cylinder(const engine::Vector3& start, double radius, double length);
/// Standing on `base`, apex up.
AnalyticModel cone(const engine::Vector3& base, double radius, double height);
/// Axis along z.
AnalyticModel flat_torus(const engine::Vector3& centre, double major_radius, double minor_radius);
/// Axis along y: sections are spiric curves (of Perseus).
AnalyticModel standing_torus(const engine::Vector3& centre, double major_radius, double minor_radius);
AnalyticModel box(const engine::Vector3& low, const engine::Vector3& high);
/// A box with an upright round hole through its middle.
AnalyticModel box_with_hole(const engine::Vector3& low, const engine::Vector3& high, double hole_radius);
/// A cylinder with an upright round hole: its ends are annuli.
AnalyticModel tube(const engine::Vector3& base, double inner_radius, double outer_radius, double height);

// The surfaces, for models with gaps, overlaps and cavities.

/// A profile in the (radius, z) half plane as rational control points (w r, w z, w), turned once around the
/// vertical axis through `axis`; u runs around, v along the profile.
struct Profile {
  int degree = 1;
  engine::Knots knots;
  std::vector<engine::Vector3> points;
};
engine::NurbsSurface revolved(const Profile& profile, const engine::Vector3& axis);
/// Straight from one point of the half plane to another.
Profile segment_profile(const engine::Vector2& from, const engine::Vector2& to);
/// The bilinear patch with these corners: (0,0), (1,0), (0,1), (1,1).
engine::NurbsSurface bilinear(const engine::Vector3& p00, const engine::Vector3& p10,
                              const engine::Vector3& p01, const engine::Vector3& p11);
engine::NurbsSurface transformed(const engine::NurbsSurface& surface, const Eigen::Affine3d& transform);
/// The part of a quadratic quarter arc in the plane from angle `from` to `to` (less than pi apart), swept
/// from z to z + height.
engine::NurbsSurface cylinder_patch(const engine::Vector3& base, double radius, double from, double to,
                                    double height);

engine::Model model_of(std::string name, const std::vector<engine::NurbsSurface>& surfaces);
/// All surfaces of all models.
engine::Model united(std::string name, const std::vector<engine::Model>& models);

}  // namespace lamina::tests
