#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "engine/geometry/vector.h"
#include "engine/pointcloud/patch_source.h"

namespace lamina::engine {

class ScanField;
class TrimRegion;

/// A Bezier patch that the current plane may meet. Its control net is cut out of the surface by whoever asks
/// first, on any thread: the planes are handed out one after the other, the nets need not be.
class FrontPatch {
 public:
  FrontPatch(std::shared_ptr<const PatchSource> source, const PatchSource::Span& place)
      : degree_u(source->degree_u()), degree_v(source->degree_v()), span(place), source_(std::move(source)) {}

  /// Homogeneous points, v fastest.
  const std::vector<Vector4>& points() const {
    if (!is_cut_.load(std::memory_order_acquire)) {
      std::call_once(cut_, [this] {
        points_ = source_->net_of(span);
        is_cut_.store(true, std::memory_order_release);
      });
    }
    return points_;
  }

  /// Of a patch that trim curves cut; null where all of it counts.
  const TrimRegion* trim() const { return span.trimmed ? source_->trim().get() : nullptr; }
  /// Opposite corners of such a patch in the surface's parameter plane.
  Vector2 low() const { return source_->low(span); }
  Vector2 high() const { return source_->high(span); }

  const int degree_u;
  const int degree_v;
  const PatchSource::Span span;

 private:
  std::shared_ptr<const PatchSource> source_;
  mutable std::once_flag cut_;
  mutable std::atomic<bool> is_cut_ = false;  // asked for a crossing at a time, which call_once is slow for
  mutable std::vector<Vector4> points_;
};

/// A triangle that the current plane may meet.
struct FrontFacet {
  Eigen::Vector3f corners[3];
  std::uint32_t mesh = 0;  ///< of the model
};

/// A scanned surface that the current plane may meet.
struct FrontScan {
  std::shared_ptr<const ScanField> field;
  std::vector<std::uint32_t> points;  ///< those near the plane
};

/// What a plane may meet of the model, in the order in which the plane reached it.
struct FrontState {
  std::vector<std::shared_ptr<const FrontPatch>> patches;
  std::vector<FrontFacet> facets;
  std::vector<std::shared_ptr<const TrimRegion>>
      regions;  ///< trimmed surfaces whose trim curves the plane may meet
  std::vector<FrontScan> scans;
  std::size_t added = 0;    ///< by the last advance, patches and facets
  std::size_t removed = 0;  ///< by the last advance
};

}  // namespace lamina::engine
