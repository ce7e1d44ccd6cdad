#pragma once

#include <string>

#include "transport/port/descriptor_port.h"

struct sp_port;

namespace lamina::transport {

/// A real serial device through libserialport: 8 data bits, no parity, one stop bit, no flow control, the
/// driver asked to pass bytes on without delay. libserialport knows how to set 250000 baud, which termios
/// alone does not.
class SerialPort : public DescriptorPort {
 public:
  /// Opens `path` at options.baud for this program alone, and treats the board behind it as options.restart
  /// says. Throws PortError.
  SerialPort(const std::string& path, const PortOptions& options);
  ~SerialPort() override;

  void close() override;
  void set_baud(int baud) override;

 private:
  void configure(const PortOptions& options);
  /// Throws if `result` of the libserialport call just made is none of success.
  void check(int result) const;
  void free_port();

  sp_port* port_ = nullptr;
  bool dtr_falls_on_close_ = true;
};

}  // namespace lamina::transport
