#pragma once

#include <memory>
#include <string>

#include "transport/port/port.h"
#include "transport/port/tcp_address.h"
#include "transport/port/tcp_port.h"

namespace lamina::transport {

/// The printer's side of a network connection, like a serial server: waits for hosts and talks to one at a
/// time. Hosts may come and go; one that comes while another is there is turned away. Without a host, what is
/// written is lost, as on a cable that leads nowhere.
class TcpHost : public Port {
 public:
  /// Waits at `where`, a name or number of this machine. Throws PortError (kBusy where the port is taken).
  explicit TcpHost(const TcpAddress& where);
  ~TcpHost() override;

  /// What a host opens, with the port that the system chose if it was to: "tcp://127.0.0.1:40123".
  std::string name() const override { return name_; }

  std::size_t read(std::span<char> into) override;
  std::size_t write(std::string_view bytes) override;
  void wait(Duration at_most, bool until_writable) override;
  void discard() override;
  void close() override;

 private:
  /// Lets a waiting host in, or turns it away.
  void accept_host();

  std::string name_;
  int listener_ = -1;
  std::unique_ptr<TcpPort> host_;
};

}  // namespace lamina::transport
