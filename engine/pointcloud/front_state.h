#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/geometry/vector.h"

namespace lamina::engine {

class ScanField;
class TrimRegion;

/// The control net of a Bezier patch that the current plane may meet; homogeneous points, v fastest.
struct FrontPatch {
  int degree_u = 1;
  int degree_v = 1;
  std::uint32_t surface = 0;  ///< of the model
  double z_min = 0.0;         ///< of the net, mm
  double z_max = 0.0;
  Vector2 low = Vector2::Zero();           ///< corner of the patch in the surface's parameter plane
  Vector2 high = Vector2::Ones();          ///< the one opposite
  std::shared_ptr<const TrimRegion> trim;  ///< of a patch that trim curves cut; null where all of it counts
  std::vector<Vector4> points;
};

/// A triangle that the current plane may meet.
struct FrontFacet {
  Eigen::Vector3f corners[3];
  std::uint32_t mesh = 0;  ///< of the model
};

/// A scanned surface that the current plane may meet.
struct FrontScan {
  std::shared_ptr<const ScanField> field;
  std::vector<std::uint32_t> points;  ///< those near the plane
};

/// What a plane may meet of the model, in the order in which the plane reached it.
struct FrontState {
  std::vector<std::shared_ptr<const FrontPatch>> patches;
  std::vector<FrontFacet> facets;
  std::vector<std::shared_ptr<const TrimRegion>>
      regions;  ///< trimmed surfaces whose trim curves the plane may meet
  std::vector<FrontScan> scans;
  std::size_t added = 0;    ///< by the last advance, patches and facets
  std::size_t removed = 0;  ///< by the last advance
};

}  // namespace lamina::engine
