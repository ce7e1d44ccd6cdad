#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/geometry/vector.h"

namespace lamina::tools {

/// Boxes of the plane in square bins, to find what lies nearest to a place.
class PlanarBins {
 public:
  PlanarBins() = default;

  explicit PlanarBins(std::vector<engine::Box2> boxes) : boxes_(std::move(boxes)) {
    if (boxes_.empty()) return;
    double side_sum = 0.0;
    for (const engine::Box2& box : boxes_) {
      all_.extend(box);
      side_sum += box.sizes().maxCoeff();
    }
    const double longest = std::max(all_.sizes().maxCoeff(), 1e-9);
    bin_size_ = std::max(side_sum / static_cast<double>(boxes_.size()), longest / kMostBinsPerSide);
    columns_ = bin_of(all_.max().x() - all_.min().x()) + 1;
    rows_ = bin_of(all_.max().y() - all_.min().y()) + 1;
    // Counted first, then filled: all lists in one array.
    first_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
    for_each_entry([&](std::size_t bin, std::uint32_t) { ++first_[bin + 1]; });
    for (std::size_t bin = 1; bin < first_.size(); ++bin) first_[bin] += first_[bin - 1];
    items_.resize(first_.back());
    std::vector<std::uint32_t> filled(first_.begin(), first_.end() - 1);
    for_each_entry([&](std::size_t bin, std::uint32_t item) { items_[filled[bin]++] = item; });
  }

  /// The least of distance(item, best so far) over all items, which must not be below the distance to the
  /// item's box in the plane. Items whose box is farther than what was found are not asked; the search ends
  /// as soon as something is within `enough`. Infinite when there are no items.
  template <typename Distance>
  double nearest(const engine::Vector2& place, double enough, Distance distance) const {
    double best = std::numeric_limits<double>::infinity();
    if (boxes_.empty()) return best;
    const engine::Vector2 from_corner = place - all_.min();
    const std::ptrdiff_t home_x = std::clamp<std::ptrdiff_t>(bin_of(from_corner.x()), 0, columns_ - 1);
    const std::ptrdiff_t home_y = std::clamp<std::ptrdiff_t>(bin_of(from_corner.y()), 0, rows_ - 1);
    std::vector<std::pair<double, std::uint32_t>> near;
    // Rings of bins around the place's own, until the ring is farther than what was found.
    for (std::ptrdiff_t ring = 0; ring <= std::max(columns_, rows_); ++ring) {
      if (static_cast<double>(ring - 1) * bin_size_ > best) break;
      near.clear();
      for (std::ptrdiff_t y = std::max<std::ptrdiff_t>(home_y - ring, 0);
           y <= std::min(home_y + ring, rows_ - 1); ++y) {
        const bool whole_row = std::abs(y - home_y) == ring;
        for (std::ptrdiff_t x = home_x - ring; x <= home_x + ring;
             x += whole_row ? 1 : std::max<std::ptrdiff_t>(2 * ring, 1)) {
          if (x < 0 || x >= columns_) continue;
          const auto bin = static_cast<std::size_t>(y * columns_ + x);
          for (std::uint32_t k = first_[bin]; k < first_[bin + 1]; ++k) {
            near.emplace_back(boxes_[items_[k]].exteriorDistance(place), items_[k]);
          }
        }
      }
      std::sort(near.begin(), near.end());
      near.erase(std::unique(near.begin(), near.end()), near.end());
      for (const auto& [to_box, item] : near) {
        if (to_box >= best) break;
        best = std::min(best, distance(item, best));
        if (best <= enough) return best;
      }
    }
    return best;
  }

 private:
  static constexpr double kMostBinsPerSide = 512.0;

  std::ptrdiff_t bin_of(double along) const {
    return static_cast<std::ptrdiff_t>(std::floor(along / bin_size_));
  }

  template <typename Visit>
  void for_each_entry(Visit visit) const {
    for (std::uint32_t item = 0; item < boxes_.size(); ++item) {
      const engine::Vector2 low = boxes_[item].min() - all_.min();
      const engine::Vector2 high = boxes_[item].max() - all_.min();
      for (std::ptrdiff_t y = bin_of(low.y()); y <= bin_of(high.y()); ++y) {
        for (std::ptrdiff_t x = bin_of(low.x()); x <= bin_of(high.x()); ++x) {
          visit(static_cast<std::size_t>(y * columns_ + x), item);
        }
      }
    }
  }

  std::vector<engine::Box2> boxes_;
  engine::Box2 all_;
  double bin_size_ = 1.0;
  std::ptrdiff_t columns_ = 0;
  std::ptrdiff_t rows_ = 0;
  std::vector<std::uint32_t> first_;  ///< of each bin's items, and the end
  std::vector<std::uint32_t> items_;
};

}  // namespace lamina::tools
