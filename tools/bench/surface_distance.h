#pragma once

#include <cstddef>
#include <vector>

#include "engine/nurbs/bezier.h"

namespace lamina::tools {

/// Distance from a point to a patch: the nearest of a coarse grid of points, then Gauss-Newton steps on the
/// squared distance with the parameters kept inside the patch (The NURBS Book, section 6.1). An upper bound
/// of the true distance; where Newton does not converge, the best point found counts, as in the dissertation
/// (p. 165).
double distance_to_patch(const engine::Vector3& point, const engine::NurbsSurface& patch);

/// Distances from points near one plane to a model that was cut into small patches.
class SurfaceDistance {
 public:
  explicit SurfaceDistance(const std::vector<engine::BezierPatch>& patches);

  /// Prepares for points at height z: the patches whose boxes come within `reach` of the plane, in bins over
  /// x and y.
  void select_plane(double z, double reach);

  /// Distance to the nearest patch of the selection, mm; infinite when the selection is empty. Patches are
  /// tried by the distance of their boxes until no box can be nearer than what was found.
  double distance(const engine::Vector3& point) const;

 private:
  struct Candidate {
    engine::NurbsSurface surface;
    engine::Box3 box;
  };

  std::vector<std::size_t>& bin(std::ptrdiff_t x, std::ptrdiff_t y) {
    return bins_[static_cast<std::size_t>(y * columns_ + x)];
  }

  std::vector<Candidate> candidates_;
  engine::Box2 selected_box_;
  double bin_size_ = 1.0;
  std::ptrdiff_t columns_ = 0;
  std::ptrdiff_t rows_ = 0;
  std::vector<std::vector<std::size_t>> bins_;  ///< candidates whose box overlaps the bin
};

}  // namespace lamina::tools
