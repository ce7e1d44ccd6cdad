#include "engine/contour/region_probe.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/geometry/segment_distance.h"

namespace lamina::engine {
RegionProbe::RegionProbe(const std::vector<NodeChain>& chains) {
  double high = -std::numeric_limits<double>::infinity();
  low_ = -high;
  for (const NodeChain& chain : chains) {
    for (std::size_t i = 0, j = chain.nodes.size() - 1; i < chain.nodes.size(); j = i++) {
      segments_.push_back({chain.nodes[j].position, chain.nodes[i].position});
      low_ = std::min(low_, chain.nodes[i].position.y());
      high = std::max(high, chain.nodes[i].position.y());
    }
  }
  if (segments_.empty()) return;
  buckets_.resize(1 + segments_.size() / 4);
  height_ = std::max(high - low_, 1e-9) / static_cast<double>(buckets_.size());
  for (std::uint32_t s = 0; s < segments_.size(); ++s) {
    const auto [first, last] = std::minmax(segments_[s].a.y(), segments_[s].b.y());
    for (std::size_t k = bucket_of(first); k <= bucket_of(last); ++k) buckets_[k].push_back(s);
  }
}

std::size_t RegionProbe::bucket_of(double y) const {
  const double k = std::floor((y - low_) / height_);
  return static_cast<std::size_t>(std::clamp(k, 0.0, static_cast<double>(buckets_.size() - 1)));
}

bool RegionProbe::contains(const Vector2& point) const {
  if (buckets_.empty()) return false;
  bool inside = false;
  for (const std::uint32_t s : buckets_[bucket_of(point.y())]) {
    const Vector2& a = segments_[s].a;
    const Vector2& b = segments_[s].b;
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < (b.x() - a.x()) * (point.y() - a.y()) / (b.y() - a.y()) + a.x()) {
      inside = !inside;
    }
  }
  return inside;
}

double RegionProbe::distance(const Vector2& point) const {
  double best = std::numeric_limits<double>::infinity();
  if (buckets_.empty()) return best;
  const std::size_t home = bucket_of(point.y());
  const auto visit = [&](std::size_t bucket) {
    for (const std::uint32_t s : buckets_[bucket])
      best = std::min(best, std::sqrt(squared_distance(point, segments_[s].a, segments_[s].b)));
  };
  // Outwards from the point's own bucket until no bucket can hold anything nearer.
  for (std::size_t reach = 0; reach < buckets_.size(); ++reach) {
    const double least = reach == 0 ? 0.0 : static_cast<double>(reach - 1) * height_;
    if (least > best && point.y() >= low_ && home + 1 < buckets_.size()) break;
    if (home >= reach) visit(home - reach);
    if (reach > 0 && home + reach < buckets_.size()) visit(home + reach);
  }
  return best;
}

}  // namespace lamina::engine
