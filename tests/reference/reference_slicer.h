#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <vector>

#include "engine/model.h"
#include "tests/reference/layer.h"
#include "tests/reference/pointcloud/patch_lists.h"
#include "tests/reference/slice_options.h"

namespace lamina::reference {

using namespace engine;

/// The model cannot be sliced with these options. The message says what to change.
struct SliceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Slices a model by the point-cloud method of chapter six, plane by plane. Holds the patches and the point
/// cloud of the current plane only; a layer belongs to the caller.
class ReferenceSlicer {
 public:
  /// Planes must rise. Throws SliceError when an option is out of its range or a plane lies below its
  /// predecessor.
  ReferenceSlicer(const Model& model, std::vector<SlicePlane> planes, const SliceOptions& options);

  /// The next layer, or nothing after the last plane. A plane that misses the model gives a layer without
  /// contours. Throws SliceError when the grid would exceed `most_cells`.
  std::optional<Layer> next();

  std::size_t layer_count() const { return planes_.size(); }
  std::size_t patch_count() const { return global_list_.size(); }

 private:
  SliceOptions options_;
  std::vector<SlicePlane> planes_;
  std::vector<ListedPatch> global_list_;
  ActiveList active_;
  std::size_t next_plane_ = 0;
};

}  // namespace lamina::reference
