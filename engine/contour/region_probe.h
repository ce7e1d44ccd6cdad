#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "engine/contour/contour_node.h"

namespace lamina::engine {

/// Answers whether points lie in the area that closed chains bound by parity, and how far from its outline.
/// Segments lie in buckets by y, so that an answer costs about the segments beside the point.
class RegionProbe {
 public:
  explicit RegionProbe(const std::vector<NodeChain>& chains);

  bool contains(const Vector2& point) const;
  /// Distance from the nearest segment, mm; infinite without any.
  double distance(const Vector2& point) const;

 private:
  struct Segment {
    Vector2 a;
    Vector2 b;
  };

  std::size_t bucket_of(double y) const;

  std::vector<Segment> segments_;
  std::vector<std::vector<std::uint32_t>> buckets_;
  double low_ = 0.0;
  double height_ = 1.0;  ///< of a bucket
};

}  // namespace lamina::engine
