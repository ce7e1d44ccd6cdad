#include "transport/port/tcp_address.h"

#include <charconv>
#include <cstring>
#include <memory>

#include <netdb.h>

#include "transport/port/port.h"

namespace lamina::transport {

namespace {

constexpr std::string_view kScheme = "tcp://";
constexpr int kLastPort = 65535;

PortError bad_address(const std::string& text) {
  return {PortProblem::kBadAddress, text, "not an address with a port"};
}

}  // namespace

bool is_tcp_address(std::string_view text) {
  return text.starts_with(kScheme);
}

TcpAddress parse_tcp_address(const std::string& text) {
  if (!is_tcp_address(text)) throw bad_address(text);
  const std::string_view rest = std::string_view(text).substr(kScheme.size());
  const std::size_t colon = rest.rfind(':');
  if (colon == std::string_view::npos) throw bad_address(text);
  std::string_view host = rest.substr(0, colon);
  const std::string_view port = rest.substr(colon + 1);
  if (host.starts_with('[') && host.ends_with(']')) {
    host = host.substr(1, host.size() - 2);
  } else if (host.find(':') != std::string_view::npos) {
    throw bad_address(text);
  }
  TcpAddress address{std::string(host), 0};
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), address.port);
  if (host.empty() || error != std::errc() || end != port.data() + port.size() || address.port < 0 ||
      address.port > kLastPort) {
    throw bad_address(text);
  }
  return address;
}

std::string to_text(const TcpAddress& address) {
  const bool brackets = address.host.find(':') != std::string::npos;
  return std::string(kScheme) + (brackets ? "[" : "") + address.host + (brackets ? "]" : "") + ":" +
         std::to_string(address.port);
}

std::vector<SocketAddress> look_up(const TcpAddress& address) {
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int result =
      ::getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(), &wanted, &found);
  if (result != 0) {
    throw PortError(PortProblem::kUnknownHost, to_text(address),
                    "no host \"" + address.host + "\": " + ::gai_strerror(result));
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> owner(found, &::freeaddrinfo);
  std::vector<SocketAddress> addresses;
  for (const addrinfo* entry = found; entry != nullptr; entry = entry->ai_next) {
    SocketAddress& added = addresses.emplace_back();
    std::memcpy(&added.bytes, entry->ai_addr, entry->ai_addrlen);
    added.size = entry->ai_addrlen;
  }
  return addresses;
}

}  // namespace lamina::transport
