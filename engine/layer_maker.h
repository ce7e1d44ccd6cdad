#pragma once

#include <cstddef>

#include "engine/contour/layer_chains.h"
#include "engine/grid/meetings.h"
#include "engine/layer.h"
#include "engine/pointcloud/front_state.h"
#include "engine/pointcloud/patch_section.h"
#include "engine/pointcloud/trim_section.h"
#include "engine/slice_options.h"
#include "engine/solid_numbers.h"

namespace lamina::engine {

/// Makes layers of the patches that a plane meets; the result depends on nothing else. Keeps the buffers of
/// one layer for the next: one maker a thread.
class LayerMaker {
 public:
  explicit LayerMaker(const SliceOptions& options, SolidNumbers solids = {});

  /// What the plane at height z and the patches have in common, as chains of exact nodes.
  LayerChains chains(const FrontState& front, double z, LayerReport& report);

  Layer make(const FrontState& front, const SlicePlane& plane, std::size_t index);

 private:
  /// What the layer's slab and the patches have in common, as `containment` asks for.
  LayerChains slab_chains(const FrontState& front, const SlicePlane& plane, LayerReport& report);

  double now() const { return options_.clock == nullptr ? 0.0 : options_.clock(); }

  SliceOptions options_;
  SolidNumbers solids_;
  PatchSection patch_section_;
  SectionTrimmer section_trimmer_;
  MeetingFinder meetings_;
  Section section_;
};

}  // namespace lamina::engine
