#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "engine/layer.h"
#include "engine/model.h"
#include "engine/pointcloud/facet_front.h"
#include "engine/pointcloud/patch_front.h"
#include "engine/pointcloud/scan_front.h"
#include "engine/slice_options.h"

namespace lamina::engine {

class LayerQueue;

/// The model cannot be sliced with these options. The message says what to change.
struct SliceError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Slices a model plane by plane at a cost that follows the length of the contours. The plane rises through
/// the global list of Bezier patches; what it meets is cut into arcs of exact nodes, linked, united where
/// contours meet, and made into curves. With several threads up to four layers a thread are made ahead of the
/// caller, always in order; the layers are the same, byte for byte, for any number of threads. Holds the
/// patches near the plane and the buffers of the layers in hand.
class Slicer {
 public:
  /// Planes must rise. Throws SliceError when an option is out of its range, a plane lies below its
  /// predecessor, a surface has too high a degree, or a scan is too sparse for epsilon.
  Slicer(const Model& model, std::vector<SlicePlane> planes, const SliceOptions& options);
  ~Slicer();
  Slicer(Slicer&&) noexcept;
  Slicer& operator=(Slicer&&) noexcept;

  /// The next layer, or nothing after the last plane. A plane that misses the model gives a layer without
  /// contours.
  std::optional<Layer> next();

  std::size_t layer_count() const { return planes_.size(); }
  std::size_t patch_count() const { return patches_.patch_count(); }

 private:
  std::vector<SlicePlane> planes_;
  bool contained_ = false;  ///< layers stand for their slabs
  PatchFront patches_;
  FacetFront facets_;
  ScanFront scans_;
  std::unique_ptr<LayerQueue> queue_;
  std::size_t next_plane_ = 0;
};

}  // namespace lamina::engine
