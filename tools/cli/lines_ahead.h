#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "transport/session/print_job.h"

namespace lamina::tools {

/// Lines in the batches in which they come about; nothing after the last batch.
using BatchSource = std::function<std::optional<std::vector<std::string>>()>;

/// Runs a source in a thread of its own, a few batches ahead of whoever takes the lines, so that slicing goes
/// on while the printer prints and a slow layer does not stop the wire.
class LinesAhead {
 public:
  /// The source is called from the other thread only, until this object is gone.
  explicit LinesAhead(BatchSource source);
  LinesAhead(const LinesAhead&) = delete;
  LinesAhead& operator=(const LinesAhead&) = delete;
  ~LinesAhead();

  /// How many lines are there without waiting.
  transport::SourceLevel level();

  /// The next line, waiting for it if need be; nothing after the last. Throws what the source threw.
  std::optional<std::string> next();

 private:
  void produce();
  bool take_batch();

  BatchSource source_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::vector<std::string>> batches_;  ///< Guarded by mutex_, as are the next three.
  bool ended_ = false;
  bool abandoned_ = false;
  std::exception_ptr error_;
  std::vector<std::string> batch_;  ///< The consumer's own.
  std::size_t next_line_ = 0;
  std::thread producer_;  ///< Last, so that it starts when everything else is there.
};

}  // namespace lamina::tools
