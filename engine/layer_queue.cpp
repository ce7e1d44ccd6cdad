#include "engine/layer_queue.h"

#include <algorithm>
#include <deque>
#include <utility>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include "engine/layer_maker.h"

namespace lamina::engine {
namespace {

constexpr std::size_t kLayersAThread = 4;

int thread_count(int asked) {
  return asked > 0 ? asked : oneapi::tbb::info::default_concurrency();
}

}  // namespace

struct LayerQueue::Workshop {
  struct Job {
    FrontState front;
    SlicePlane plane;
    std::size_t index = 0;
    Layer layer;
    oneapi::tbb::task_group group;
  };

  Workshop(const SliceOptions& options, SolidNumbers solids)
      : threads(thread_count(options.threads)),
        arena(std::min(threads, oneapi::tbb::info::default_concurrency())),  // it would warn of more
        makers([options, numbers = std::move(solids)] { return LayerMaker(options, numbers); }) {}

  void make(Job& job) {
    job.layer = makers.local().make(job.front, job.plane, job.index);
    job.front = {};
  }

  int threads;
  oneapi::tbb::task_arena arena;
  oneapi::tbb::enumerable_thread_specific<LayerMaker> makers;
  std::deque<Job> jobs;
};

LayerQueue::LayerQueue(const SliceOptions& options, SolidNumbers solids)
    : workshop_(std::make_unique<Workshop>(options, std::move(solids))) {}

LayerQueue::~LayerQueue() {
  for (Workshop::Job& job : workshop_->jobs) {
    job.group.cancel();
    workshop_->arena.execute([&] { job.group.wait(); });
  }
}

bool LayerQueue::has_room() const {
  const std::size_t room =
      workshop_->threads == 1 ? 1 : kLayersAThread * static_cast<std::size_t>(workshop_->threads);
  return workshop_->jobs.size() < room;
}

void LayerQueue::push(FrontState front, const SlicePlane& plane, std::size_t index) {
  Workshop::Job& job = workshop_->jobs.emplace_back();
  job.front = std::move(front);
  job.plane = plane;
  job.index = index;
  if (workshop_->threads == 1) return;
  workshop_->arena.execute([&] { job.group.run([this, &job] { workshop_->make(job); }); });
}

std::optional<Layer> LayerQueue::pop() {
  if (workshop_->jobs.empty()) return std::nullopt;
  Workshop::Job& job = workshop_->jobs.front();
  if (workshop_->threads == 1) {
    workshop_->make(job);
  } else {
    workshop_->arena.execute([&] { job.group.wait(); });
  }
  Layer layer = std::move(job.layer);
  workshop_->jobs.pop_front();
  return layer;
}

}  // namespace lamina::engine
