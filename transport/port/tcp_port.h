#pragma once

#include <string>

#include "transport/port/descriptor_port.h"
#include "transport/port/tcp_address.h"

namespace lamina::transport {

/// One end of a TCP connection that carries the printer's bytes as they are (ser2net in raw mode, ESP3D, an
/// emulated printer). Small writes leave at once; a peer that vanishes without a word is noticed within about
/// half a minute.
class TcpPort : public DescriptorPort {
 public:
  /// Connects, to each of the host's addresses in turn until one answers; `timeout` is for all of them, the
  /// name server's answer excluded. Throws PortError (kUnknownHost, kRefused, kUnreachable).
  TcpPort(const TcpAddress& address, Duration timeout);

  /// Takes over a connected socket.
  TcpPort(int socket, const std::string& name);

  ~TcpPort() override;

  /// Only what has arrived; what was written is on its way.
  void discard() override;
  void close() override;

 private:
  ssize_t send(std::string_view bytes) override;
  void set_up();
};

}  // namespace lamina::transport
