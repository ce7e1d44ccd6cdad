#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/model.h"
#include "engine/nurbs/bezier.h"
#include "tools/bench/planar_bins.h"

namespace lamina::tools {

/// Points of a patch at u and v in {0, 1/2, 1}, v fastest.
using CoarseGrid = std::array<engine::Vector3, 9>;
CoarseGrid coarse_grid(const engine::BezierPatch& patch);

/// Distance from a point to a patch: the nearest point of the coarse grid, then Gauss-Newton steps on the
/// squared distance with the parameters kept inside the patch (The NURBS Book, section 6.1). An upper bound
/// of the true distance: it may end at a local minimum.
double distance_to_patch(const engine::Vector3& point, const engine::BezierPatch& patch,
                         const CoarseGrid& coarse);

/// The least of `best` and the distance to the patch, to 1e-6 mm: halves of the patch are searched, the
/// nearest first, until no box of their nets can be nearer.
double certain_distance_to_patch(const engine::Vector3& point, const engine::BezierPatch& patch, double best);

/// Distances from points near one plane to a model's surfaces.
class SurfaceDistance {
 public:
  explicit SurfaceDistance(const engine::Model& model);

  /// Prepares for points at height z: the patches whose boxes come within `reach` of the plane.
  void select_plane(double z, double reach);

  struct Trust {
    double enough = 0.0;  ///< mm; the search ends as soon as a patch is that near
    double local = 0.0;   ///< mm; up to this Newton's local minimum is taken, above it is made certain
  };

  /// Distance to the nearest patch of the selection, mm; infinite when the selection is empty. Up to
  /// `trust.local` an upper bound of the true distance, above it the true one.
  double distance(const engine::Vector3& point, const Trust& trust) const;

 private:
  struct Candidate {
    engine::BezierPatch patch;
    engine::Box3 box;
    CoarseGrid coarse;
  };

  std::vector<Candidate> candidates_;
  std::vector<std::uint32_t> selected_;
  PlanarBins bins_;
};

}  // namespace lamina::tools
