#pragma once

#include <cstdint>
#include <optional>

#include "engine/model.h"
#include "engine/scan/point_tree.h"

namespace lamina::engine {

/// The surface that the points of a scan lie on: at each place the sphere that fits the points around it and
/// their normals best (algebraic point set surfaces; Guennebaud and Gross, 2007). Spheres and planes are met
/// exactly, other surfaces but for the difference of their curvatures, and noise is averaged over some ten
/// points. Points that face away from the nearest one are left aside, so that thin walls keep both sides.
class ScanField {
 public:
  explicit ScanField(const PointCloud& cloud);

  const PointCloud& cloud() const { return cloud_; }

  struct Value {
    double distance = 0.0;             ///< of the place from the surface, mm, positive outside
    Vector3 normal = Vector3::Zero();  ///< outwards, of unit length
    double clearance = 0.0;            ///< distance of the nearest point, mm
  };

  static constexpr std::uint32_t kNone = 0xffffffff;

  /// Nothing where no point lies within `farthest` (mm). `left_out` is a point that does not count.
  std::optional<Value> at(const Vector3& place, double farthest, std::uint32_t left_out = kNone) const;

 private:
  PointCloud cloud_;
  PointTree tree_;
};

}  // namespace lamina::engine
