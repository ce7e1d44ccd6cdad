#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <sys/socket.h>

namespace lamina::transport {

/// Where a TCP connection leads, or where one is waited for.
struct TcpAddress {
  std::string host;  ///< name, or number of an IPv4 or IPv6 address, without brackets
  int port = 0;      ///< 0 only to wait: the system chooses one
};

/// True for what begins with tcp://.
bool is_tcp_address(std::string_view text);

/// Reads "tcp://HOST:PORT"; an IPv6 number stands in brackets. Throws PortError (kBadAddress).
TcpAddress parse_tcp_address(const std::string& text);

/// The same as text; parse_tcp_address reads it.
std::string to_text(const TcpAddress& address);

/// One way to reach a host, as the system's calls want it.
struct SocketAddress {
  sockaddr_storage bytes{};
  socklen_t size = 0;
  int family() const { return bytes.ss_family; }
};

/// What the host's name means, the best way first; at least one. Asks the name server, which may take some
/// seconds. Throws PortError (kUnknownHost).
std::vector<SocketAddress> look_up(const TcpAddress& address);

}  // namespace lamina::transport
