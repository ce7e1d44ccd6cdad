#pragma once

#include <array>
#include <chrono>
#include <string>

#include "transport/port/port.h"

namespace lamina::tests {

/// What arrives at the port until it is `count` bytes, for `time` at most.
inline std::string read_within(transport::Port& port, std::size_t count, transport::Duration time) {
  std::string read;
  const auto end = std::chrono::steady_clock::now() + time;
  while (read.size() < count && std::chrono::steady_clock::now() < end) {
    std::array<char, 256> bytes;
    read.append(bytes.data(), port.read(bytes));
    if (read.size() < count) port.wait(std::chrono::milliseconds(10), false);
  }
  return read;
}

}  // namespace lamina::tests
