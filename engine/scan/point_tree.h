#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/geometry/vector.h"

namespace lamina::engine {

/// Finds the neighbours of a place among points: a k-d tree (Bentley, 1975) in the order of an array, each
/// half around its median.
class PointTree {
 public:
  explicit PointTree(const std::vector<Eigen::Vector3f>& points);

  struct Neighbour {
    std::uint32_t point = 0;
    float squared = std::numeric_limits<float>::infinity();  ///< distance
  };

  /// The points, by their numbers, so that neighbours come soon after each other.
  std::vector<std::uint32_t> order() const;

  /// The nearest points, by ascending distance; fewer than `count` where there are no more within `farthest`.
  std::vector<Neighbour> nearest(const Eigen::Vector3f& place, std::size_t count,
                                 float farthest = std::numeric_limits<float>::infinity()) const;

  /// Calls `visit(point, squared distance)` for each point within `radius`.
  template <typename Visit>
  void for_each_within(const Eigen::Vector3f& place, float radius, Visit visit) const {
    walk_within(0, places_.size(), place, radius, radius * radius, visit);
  }

 private:
  struct Place {
    Eigen::Vector3f position;
    std::uint32_t point;
  };

  /// What lies below comes first, what lies above behind it; what lies there may be in either half.
  struct Split {
    std::uint8_t axis = 0;
    float at = 0.0F;
  };

  static constexpr std::size_t kLeaf = 8;

  void build(std::size_t first, std::size_t last);
  void search(std::size_t first, std::size_t last, const Eigen::Vector3f& place,
              std::vector<Neighbour>& best) const;

  template <typename Visit>
  void walk_within(std::size_t first, std::size_t last, const Eigen::Vector3f& place, float radius,
                   float squared, Visit& visit) const {
    if (last - first <= kLeaf) {
      for (std::size_t i = first; i < last; ++i) {
        const float distance = (places_[i].position - place).squaredNorm();
        if (distance <= squared) visit(places_[i].point, distance);
      }
      return;
    }
    const std::size_t middle = (first + last) / 2;
    const Split& split = splits_[middle];
    const float away = place[split.axis] - split.at;
    if (away <= radius) walk_within(first, middle, place, radius, squared, visit);
    if (away >= -radius) walk_within(middle, last, place, radius, squared, visit);
  }

  std::vector<Place> places_;
  std::vector<Split> splits_;  ///< by the middle of what they split
};

}  // namespace lamina::engine
