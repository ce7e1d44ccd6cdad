#include "transport/port/memory_port.h"

#include <algorithm>
#include <array>
#include <condition_variable>
#include <deque>
#include <mutex>

namespace lamina::transport {

namespace {

/// What both ends share. `bytes[side]` waits to be read by `side`.
struct Cable {
  std::mutex mutex;
  std::condition_variable changed;
  std::array<std::deque<char>, 2> bytes;
  std::array<bool, 2> open{true, true};
};

class MemoryPort : public Port {
 public:
  MemoryPort(std::shared_ptr<Cable> cable, std::size_t side) : cable_(std::move(cable)), side_(side) {}
  ~MemoryPort() override { MemoryPort::close(); }

  std::size_t read(std::span<char> into) override {
    const std::lock_guard lock(cable_->mutex);
    std::deque<char>& waiting = cable_->bytes[side_];
    if (waiting.empty() && !cable_->open[1 - side_]) throw unplugged();
    const std::size_t count = std::min(into.size(), waiting.size());
    const auto end = waiting.begin() + static_cast<std::ptrdiff_t>(count);
    std::copy(waiting.begin(), end, into.begin());
    waiting.erase(waiting.begin(), end);
    return count;
  }

  std::size_t write(std::string_view bytes) override {
    const std::lock_guard lock(cable_->mutex);
    if (!cable_->open[1 - side_]) throw unplugged();
    std::deque<char>& waiting = cable_->bytes[1 - side_];
    waiting.insert(waiting.end(), bytes.begin(), bytes.end());
    cable_->changed.notify_all();
    return bytes.size();
  }

  void wait(Duration at_most, bool until_writable) override {
    if (until_writable) return;
    std::unique_lock lock(cable_->mutex);
    cable_->changed.wait_for(lock, at_most,
                             [&] { return !cable_->bytes[side_].empty() || !cable_->open[1 - side_]; });
  }

  void discard() override {
    const std::lock_guard lock(cable_->mutex);
    for (std::deque<char>& waiting : cable_->bytes) waiting.clear();
  }

  void close() override {
    const std::lock_guard lock(cable_->mutex);
    cable_->open[side_] = false;
    cable_->changed.notify_all();
  }

  std::string name() const override { return "memory"; }

 private:
  static PortError unplugged() { return {PortProblem::kUnplugged, "memory", "the other end was closed"}; }

  std::shared_ptr<Cable> cable_;
  std::size_t side_;
};

}  // namespace

MemoryPorts make_memory_ports() {
  auto cable = std::make_shared<Cable>();
  return {std::make_unique<MemoryPort>(cable, 0), std::make_unique<MemoryPort>(cable, 1)};
}

}  // namespace lamina::transport
