#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "engine/model.h"
#include "engine/pointcloud/front_state.h"
#include "engine/pointcloud/patch_source.h"

namespace lamina::engine {

/// The model's Bezier patches by ascending z minimum (the global list), and those that a rising plane may
/// meet (the active list; dissertation p. 124 to 128). A net is cut out of its surface when it is first asked
/// for and freed when the plane has passed, so memory follows the section, not the model.
class PatchFront {
 public:
  explicit PatchFront(const Model& model);

  /// Moves the plane up to z: patches whose z interval lies within `reach` of it become active. z must not
  /// decrease.
  void advance(double z, double reach);

  /// The active list; no facets.
  const FrontState& state() const { return state_; }
  std::size_t patch_count() const { return spans_.size(); }

 private:
  std::vector<std::shared_ptr<const PatchSource>> sources_;
  std::vector<std::shared_ptr<const TrimRegion>> regions_;  // of the trimmed ones
  std::vector<PatchSource::Span> spans_;
  FrontState state_;
  std::size_t next_ = 0;
};

}  // namespace lamina::engine
