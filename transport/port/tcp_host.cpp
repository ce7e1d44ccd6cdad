#include "transport/port/tcp_host.h"

#include <algorithm>
#include <array>
#include <cerrno>

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace lamina::transport {

namespace {

constexpr int kBacklog = 4;

int listen_at(const SocketAddress& address) {
  const int socket = ::socket(address.family(), SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket < 0) return -1;
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (::bind(socket, reinterpret_cast<const sockaddr*>(&address.bytes), address.size) == 0 &&
      ::listen(socket, kBacklog) == 0) {
    return socket;
  }
  const int error = errno;
  ::close(socket);
  errno = error;
  return -1;
}

int port_of(int socket) {
  SocketAddress bound;
  bound.size = sizeof bound.bytes;
  ::getsockname(socket, reinterpret_cast<sockaddr*>(&bound.bytes), &bound.size);
  return ntohs(bound.family() == AF_INET6 ? reinterpret_cast<const sockaddr_in6*>(&bound.bytes)->sin6_port
                                          : reinterpret_cast<const sockaddr_in*>(&bound.bytes)->sin_port);
}

}  // namespace

TcpHost::TcpHost(const TcpAddress& where) : name_(to_text(where)) {
  int error = 0;
  for (const SocketAddress& way : look_up(where)) {
    listener_ = listen_at(way);
    if (listener_ >= 0) break;
    error = errno;
  }
  if (error == EADDRINUSE && listener_ < 0) {
    throw PortError(PortProblem::kBusy, name_, "the port is taken");
  }
  if (listener_ < 0) throw port_error_from_errno(error, name_);
  name_ = to_text(TcpAddress{where.host, port_of(listener_)});
}

TcpHost::~TcpHost() {
  TcpHost::close();
}

std::size_t TcpHost::read(std::span<char> into) {
  accept_host();
  if (!host_) return 0;
  try {
    return host_->read(into);
  } catch (const PortError&) {
    host_.reset();
    return 0;
  }
}

std::size_t TcpHost::write(std::string_view bytes) {
  accept_host();
  if (!host_) return bytes.size();
  try {
    return host_->write(bytes);
  } catch (const PortError&) {
    host_.reset();
    return bytes.size();
  }
}

void TcpHost::wait(Duration at_most, bool until_writable) {
  // A host that was there has priority; a second one at the door waits for its refusal until the next call.
  if (host_) return host_->wait(at_most, until_writable);
  const auto at_most_ms = std::chrono::ceil<std::chrono::milliseconds>(at_most).count();
  pollfd watched{listener_, POLLIN, 0};
  const int ready = ::poll(&watched, 1, static_cast<int>(std::clamp<std::int64_t>(at_most_ms, 0, 60'000)));
  if (ready < 0 && errno != EINTR) throw port_error_from_errno(errno, name_);
}

void TcpHost::discard() {
  if (host_) host_->discard();
}

void TcpHost::close() {
  host_.reset();
  if (listener_ >= 0) ::close(listener_);
  listener_ = -1;
}

void TcpHost::accept_host() {
  const int socket = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (socket < 0) return;
  if (host_) {
    ::close(socket);
    return;
  }
  host_ = std::make_unique<TcpPort>(socket, name_);
}

}  // namespace lamina::transport
