#include "engine/pointcloud/patch_front.h"

#include <algorithm>
#include <tuple>

#include "engine/pointcloud/trim_region.h"

namespace lamina::engine {

PatchFront::PatchFront(const Model& model) {
  sources_.reserve(model.surfaces.size());
  std::size_t count = 0;
  for (const Surface& surface : model.surfaces) {
    sources_.push_back(std::make_shared<PatchSource>(surface, static_cast<std::uint32_t>(sources_.size())));
    count += sources_.back()->count();
    if (sources_.back()->trim() != nullptr) regions_.push_back(sources_.back()->trim());
  }
  spans_.reserve(count);
  for (const auto& source : sources_) {
    const std::vector<PatchSource::Span> spans = source->spans();
    spans_.insert(spans_.end(), spans.begin(), spans.end());
  }
  std::sort(spans_.begin(), spans_.end(), [](const PatchSource::Span& a, const PatchSource::Span& b) {
    return std::tie(a.z_min, a.surface, a.u, a.v) < std::tie(b.z_min, b.surface, b.u, b.v);
  });
}

void PatchFront::advance(double z, double reach) {
  state_.removed =
      std::erase_if(state_.patches, [&](const auto& patch) { return patch->span.z_max < z - reach; });
  state_.added = 0;
  for (; next_ < spans_.size() && spans_[next_].z_min <= z + reach; ++next_) {
    const PatchSource::Span& span = spans_[next_];
    if (span.z_max < z - reach) continue;  // between two planes: never met
    state_.patches.push_back(std::make_shared<FrontPatch>(sources_[span.surface], span));
    ++state_.added;
  }
  state_.regions.clear();
  for (const auto& region : regions_) {
    if (region->z_min() <= z + reach && region->z_max() >= z - reach) state_.regions.push_back(region);
  }
}

}  // namespace lamina::engine
