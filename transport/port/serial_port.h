#pragma once

#include <string>

#include "transport/port/descriptor_port.h"

struct sp_port;

namespace lamina::transport {

/// A real serial device through libserialport: 8 data bits, no parity, one stop bit, no flow control.
/// libserialport knows how to set 250000 baud, which termios alone does not.
class SerialPort : public DescriptorPort {
 public:
  /// Opens `path` at `baud` bits per second for this program alone. Most boards restart when they are opened.
  /// Throws PortError.
  SerialPort(const std::string& path, int baud);
  ~SerialPort() override;

  void close() override;

 private:
  sp_port* port_ = nullptr;
};

}  // namespace lamina::transport
