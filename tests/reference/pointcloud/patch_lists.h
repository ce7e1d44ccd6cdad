#pragma once

#include <cstddef>
#include <vector>

#include "engine/nurbs/bezier.h"
#include "tests/reference/pointcloud/sample.h"

namespace lamina::reference {

using namespace engine;

/// A patch with the z interval of its control net, which contains that of the patch.
struct ListedPatch {
  BezierPatch patch;
  Box3 box;
};

/// All patches, by ascending lower end of their z interval; equal ones stay in the order of the model.
std::vector<ListedPatch> make_global_list(std::vector<BezierPatch> patches);

/// A patch that the current plane may meet, and its point cloud.
struct ActivePatch {
  std::size_t index = 0;  ///< into the global list
  std::vector<Vector3> points;
};

/// The patches that a rising slicing plane meets. A patch is sampled once, when the plane first reaches it,
/// and its points are freed when the plane has passed it (dissertation p. 124 to 128).
class ActiveList {
 public:
  /// Allocates global size * lambda / height places, the expected share of one layer; grows by doubling.
  ActiveList(const std::vector<ListedPatch>& global_list, double layer_thickness, double height);

  /// Moves the plane up to z: adds and samples the patches that begin within `reach` above z, removes those
  /// that ended more than `reach` below it. Points that far from the plane still matter for its grid. z must
  /// not decrease.
  void advance(const std::vector<ListedPatch>& global_list, double z, double reach,
               const SampleOptions& options);

  const std::vector<ActivePatch>& patches() const { return patches_; }
  std::size_t added() const { return added_; }      ///< patches added by the last advance
  std::size_t removed() const { return removed_; }  ///< patches removed by the last advance

 private:
  std::vector<ActivePatch> patches_;
  std::size_t next_ = 0;  ///< first patch of the global list that is still above the plane
  std::size_t added_ = 0;
  std::size_t removed_ = 0;
};

}  // namespace lamina::reference
