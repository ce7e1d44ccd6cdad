#pragma once

#include <cstddef>
#include <deque>
#include <string_view>

namespace lamina::transport {

/// The firmware's ring of received bytes.
class ReceiveBuffer {
 public:
  /// `size` bytes, of which one always stays free.
  explicit ReceiveBuffer(std::size_t size) : capacity_(size - 1) {}

  /// Takes as many of `bytes` as there is room for; returns how many.
  std::size_t push(std::string_view bytes);

  /// The oldest byte, taken out. Must not be empty.
  char pop();

  void clear() { bytes_.clear(); }
  bool empty() const { return bytes_.empty(); }
  std::size_t room() const { return capacity_ - bytes_.size(); }

 private:
  std::size_t capacity_;
  std::deque<char> bytes_;
};

}  // namespace lamina::transport
