#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/model.h"
#include "engine/nurbs/bezier.h"
#include "tools/bench/planar_bins.h"
#include "tools/bench/trim_outline.h"

namespace lamina::tools {

/// Points of a patch at u and v in {0, 1/2, 1}, v fastest.
using CoarseGrid = std::array<engine::Vector3, 9>;
CoarseGrid coarse_grid(const engine::BezierPatch& patch);

struct FootPoint {
  double distance = 0.0;                                 ///< mm
  engine::Vector2 parameters = engine::Vector2::Zero();  ///< on the patch
};

/// The nearest point of a patch: the nearest point of the coarse grid, then Gauss-Newton steps on the squared
/// distance with the parameters kept inside the patch (The NURBS Book, section 6.1). The distance is an upper
/// bound of the true one: it may be that of a local minimum.
FootPoint foot_on_patch(const engine::Vector3& point, const engine::BezierPatch& patch,
                        const CoarseGrid& coarse);

/// The nearest point of a patch, its distance to 1e-6 mm; when nothing is nearer than `farthest` (mm), that:
/// halves of the patch are searched, the nearest first, until no box of their nets can be nearer.
FootPoint certain_foot_on_patch(const engine::Vector3& point, const engine::BezierPatch& patch,
                                double farthest);

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
  /// `trust.local` an upper bound of the true distance, above it the true one. Of a patch that trim curves
  /// cut, where its nearest point is trimmed away, it is the distance to the rim: an upper bound.
  double distance(const engine::Vector3& point, const Trust& trust) const;

 private:
  struct Candidate {
    const ModelPatch* part = nullptr;
    engine::Box3 box;
    CoarseGrid coarse;
  };

  static double distance_to(const ModelPatch& part, const engine::Vector3& point, const FootPoint& foot,
                            double best);

  ModelPatches parts_;
  std::vector<Candidate> candidates_;
  std::vector<std::uint32_t> selected_;
  PlanarBins bins_;
};

}  // namespace lamina::tools
