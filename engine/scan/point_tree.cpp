#include "engine/scan/point_tree.h"

#include <algorithm>

namespace lamina::engine {

PointTree::PointTree(const std::vector<Eigen::Vector3f>& points) : splits_(points.size()) {
  places_.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) places_.push_back({points[i], i});
  build(0, places_.size());
}

void PointTree::build(std::size_t first, std::size_t last) {
  if (last - first <= kLeaf) return;
  Eigen::AlignedBox3f box;
  for (std::size_t i = first; i < last; ++i) box.extend(places_[i].position);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const std::size_t middle = (first + last) / 2;
  const auto begin = places_.begin();
  std::nth_element(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(middle),
                   begin + static_cast<std::ptrdiff_t>(last), [axis](const Place& a, const Place& b) {
                     // Points in one place by their number, so that the tree has one shape.
                     if (a.position[axis] != b.position[axis]) return a.position[axis] < b.position[axis];
                     return a.point < b.point;
                   });
  splits_[middle] = {static_cast<std::uint8_t>(axis), places_[middle].position[axis]};
  build(first, middle);
  build(middle, last);
}

std::vector<std::uint32_t> PointTree::order() const {
  std::vector<std::uint32_t> order;
  order.reserve(places_.size());
  for (const Place& place : places_) order.push_back(place.point);
  return order;
}

void PointTree::search(std::size_t first, std::size_t last, const Eigen::Vector3f& place,
                       std::vector<Neighbour>& best) const {
  if (last - first <= kLeaf) {
    for (std::size_t i = first; i < last; ++i) {
      const float distance = (places_[i].position - place).squaredNorm();
      if (distance >= best.back().squared) continue;
      best.back() = {places_[i].point, distance};
      for (std::size_t k = best.size() - 1; k > 0 && best[k].squared < best[k - 1].squared; --k)
        std::swap(best[k], best[k - 1]);
    }
    return;
  }
  const std::size_t middle = (first + last) / 2;
  const Split& split = splits_[middle];
  const float away = place[split.axis] - split.at;
  const bool is_low = away < 0.0F;
  search(is_low ? first : middle, is_low ? middle : last, place, best);
  if (away * away < best.back().squared) search(is_low ? middle : first, is_low ? last : middle, place, best);
}

std::vector<PointTree::Neighbour> PointTree::nearest(const Eigen::Vector3f& place, std::size_t count,
                                                     float farthest) const {
  constexpr std::uint32_t kNone = 0xffffffff;
  std::vector<Neighbour> best(std::min(count, places_.size()), Neighbour{kNone, farthest * farthest});
  if (!best.empty()) search(0, places_.size(), place, best);
  while (!best.empty() && best.back().point == kNone) best.pop_back();
  return best;
}

}  // namespace lamina::engine
