#pragma once

#include <memory>

#include "transport/port/port.h"

namespace lamina::transport {

/// Two ports joined back to back: what one writes the other reads.
struct MemoryPorts {
  std::unique_ptr<Port> host;
  std::unique_ptr<Port> device;
};

/// A pair in memory. Each end belongs to one thread; the two threads may differ. An end whose peer was closed
/// still reads what had been written, then throws PortError (kUnplugged).
MemoryPorts make_memory_ports();

}  // namespace lamina::transport
