#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "engine/layer.h"
#include "engine/pointcloud/front_state.h"
#include "engine/slice_options.h"
#include "engine/solid_numbers.h"

namespace lamina::engine {

/// Layers being made, first in, first out: with one thread each one when it is taken out, with several at
/// most four a thread at the same time. The one place that knows of threads (oneTBB).
class LayerQueue {
 public:
  LayerQueue(const SliceOptions& options, SolidNumbers solids);
  /// Waits for what is being made.
  ~LayerQueue();
  LayerQueue(const LayerQueue&) = delete;
  LayerQueue& operator=(const LayerQueue&) = delete;

  bool has_room() const;
  void push(FrontState front, const SlicePlane& plane, std::size_t index);
  /// The layer pushed first, or nothing when the queue is empty. Throws what its making threw.
  std::optional<Layer> pop();

 private:
  struct Workshop;
  std::unique_ptr<Workshop> workshop_;
};

}  // namespace lamina::engine
