#pragma once

#include <string>

#include "transport/port/descriptor_port.h"

namespace lamina::transport {

/// The printer's side of a new pseudo-terminal: makes the pair, sets it raw, and names the path that a host
/// opens. It keeps the host's side open itself, so that a host may come and go without a hang-up and without
/// the terminal falling back to echo and line editing in between.
class PtyHost : public DescriptorPort {
 public:
  /// Throws PortError when the system has no pseudo-terminal left.
  PtyHost();
  ~PtyHost() override;

  /// What a host opens, /dev/pts/N.
  const std::string& path() const { return path_; }

  /// The speed that a host has set, bits per second. Bytes pass at any.
  int host_baud() const;

  void close() override;

 private:
  int host_side_ = -1;
};

}  // namespace lamina::transport
