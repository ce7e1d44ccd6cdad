#include "transport/emulator/receive_buffer.h"

#include <algorithm>
#include <cassert>

namespace lamina::transport {

std::size_t ReceiveBuffer::push(std::string_view bytes) {
  const std::string_view taken = bytes.substr(0, room());
  bytes_.insert(bytes_.end(), taken.begin(), taken.end());
  return taken.size();
}

char ReceiveBuffer::pop() {
  assert(!bytes_.empty());
  const char byte = bytes_.front();
  bytes_.pop_front();
  return byte;
}

}  // namespace lamina::transport
