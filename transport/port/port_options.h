#pragma once

namespace lamina::transport {

struct PortOptions {
  /// Bits per second on a real serial line; a pseudo-terminal and native USB ignore it. DEFAULT: 115200.
  int baud = 115200;
};

}  // namespace lamina::transport
