#include "tools/cli/lines_ahead.h"

#include <algorithm>
#include <utility>

namespace lamina::tools {
namespace {

constexpr std::size_t kBatchesAhead = 8;
constexpr std::size_t kPlentyAhead = 4;

}  // namespace

LinesAhead::LinesAhead(BatchSource source) : source_(std::move(source)), producer_([this] { produce(); }) {}

LinesAhead::~LinesAhead() {
  {
    const std::lock_guard lock(mutex_);
    abandoned_ = true;
  }
  changed_.notify_all();
  producer_.join();
}

transport::SourceLevel LinesAhead::level() {
  const std::lock_guard lock(mutex_);
  if (ended_ || batches_.size() >= kPlentyAhead) return transport::SourceLevel::kPlenty;
  // A batch may be empty: the first layers give no lines before those above are known.
  const bool lines =
      next_line_ < batch_.size() ||
      std::any_of(batches_.begin(), batches_.end(), [](const auto& batch) { return !batch.empty(); });
  return lines ? transport::SourceLevel::kSome : transport::SourceLevel::kEmpty;
}

std::optional<std::string> LinesAhead::next() {
  while (next_line_ == batch_.size()) {
    if (!take_batch()) return std::nullopt;
  }
  return std::move(batch_[next_line_++]);
}

/// Waits for a batch. False at the end.
bool LinesAhead::take_batch() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !batches_.empty() || ended_; });
  if (batches_.empty()) {
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    return false;
  }
  batch_ = std::move(batches_.front());
  next_line_ = 0;
  batches_.pop_front();
  lock.unlock();
  changed_.notify_all();
  return true;
}

void LinesAhead::produce() {
  std::exception_ptr error;
  try {
    while (std::optional<std::vector<std::string>> batch = source_()) {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return batches_.size() < kBatchesAhead || abandoned_; });
      if (abandoned_) break;
      batches_.push_back(*std::move(batch));
      lock.unlock();
      changed_.notify_all();
    }
  } catch (...) {
    error = std::current_exception();
  }
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    error_ = error;
  }
  changed_.notify_all();
}

}  // namespace lamina::tools
