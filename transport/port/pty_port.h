#pragma once

#include <string>

#include "transport/port/descriptor_port.h"

namespace lamina::transport {

/// An existing pseudo-terminal (an emulated printer), opened raw by termios. libserialport refuses these: it
/// looks names up in sysfs, where they have no entry.
class PtyPort : public DescriptorPort {
 public:
  /// Opens `path` for this program alone, and drops what lay unread in it. The speed makes no difference, but
  /// the other end can see it. Throws PortError.
  PtyPort(const std::string& path, int baud);
  ~PtyPort() override;

  void close() override;
  void set_baud(int baud) override;
};

}  // namespace lamina::transport
