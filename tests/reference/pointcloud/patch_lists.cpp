#include "tests/reference/pointcloud/patch_lists.h"

#include <algorithm>
#include <cmath>

namespace lamina::reference {

std::vector<ListedPatch> make_global_list(std::vector<BezierPatch> patches) {
  std::vector<ListedPatch> list;
  list.reserve(patches.size());
  for (BezierPatch& patch : patches) {
    const Box3 box = control_box(patch.net);
    list.push_back({std::move(patch), box});
  }
  std::stable_sort(list.begin(), list.end(), [](const ListedPatch& a, const ListedPatch& b) {
    return a.box.min().z() < b.box.min().z();
  });
  return list;
}

ActiveList::ActiveList(const std::vector<ListedPatch>& global_list, double layer_thickness, double height) {
  const double share = height > 0.0 ? std::min(1.0, layer_thickness / height) : 1.0;
  patches_.reserve(static_cast<std::size_t>(std::ceil(static_cast<double>(global_list.size()) * share)));
}

void ActiveList::advance(const std::vector<ListedPatch>& global_list, double z, double reach,
                         const SampleOptions& options) {
  const std::size_t before = patches_.size();
  std::erase_if(patches_, [&](const ActivePatch& active) {
    return global_list[active.index].box.max().z() < z - reach;
  });
  removed_ = before - patches_.size();
  added_ = 0;
  for (; next_ < global_list.size() && global_list[next_].box.min().z() <= z + reach; ++next_) {
    if (global_list[next_].box.max().z() < z - reach) continue;  // between two planes: never met
    if (patches_.size() == patches_.capacity())
      patches_.reserve(std::max<std::size_t>(1, 2 * patches_.capacity()));
    patches_.push_back({next_, sample(global_list[next_].patch, options)});
    ++added_;
  }
}

}  // namespace lamina::reference
