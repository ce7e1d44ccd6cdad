#include "transport/port/tcp_port.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>

#include <fcntl.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace lamina::transport {

namespace {

using Clock = std::chrono::steady_clock;

// A peer is gone after ten silent seconds and three questions, or when it has confirmed nothing for this
// long.
constexpr int kSilentSeconds = 10;
constexpr int kSecondsBetweenQuestions = 5;
constexpr int kQuestions = 3;
constexpr int kUnconfirmedMs = 25'000;

void set_option(int socket, int level, int option, int value) {
  ::setsockopt(socket, level, option, &value, sizeof value);
}

/// Waits for a connection under way. Returns 0, or the error (errno) with which it failed.
int await_connection(int socket, Clock::time_point end) {
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd watched{socket, POLLOUT, 0};
    const int ready = ::poll(&watched, 1, static_cast<int>(std::max<std::int64_t>(left, 0)));
    if (ready > 0) break;
    if (ready == 0) return ETIMEDOUT;
    if (errno != EINTR) return errno;
  }
  int error = 0;
  socklen_t size = sizeof error;
  if (::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) != 0) return errno;
  return error;
}

/// A connected socket, or -1 and the reason in `errno`.
int connect_to(const SocketAddress& address, Clock::time_point end) {
  const int socket = ::socket(address.family(), SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket < 0) return -1;
  const auto* const bytes = reinterpret_cast<const sockaddr*>(&address.bytes);
  int error = ::connect(socket, bytes, address.size) == 0 ? 0 : errno;
  if (error == EINPROGRESS || error == EINTR) error = await_connection(socket, end);
  if (error == 0) return socket;
  ::close(socket);
  errno = error;
  return -1;
}

PortError connect_error(int error, const TcpAddress& address, Duration timeout) {
  const std::string name = to_text(address);
  switch (error) {
    case ECONNREFUSED:
      return {PortProblem::kRefused, name, "nothing listens at port " + std::to_string(address.port)};
    case ETIMEDOUT:
      return {PortProblem::kUnreachable, name,
              "no answer within " + std::to_string(std::chrono::ceil<std::chrono::seconds>(timeout).count()) +
                  " s"};
    case EHOSTUNREACH:
    case ENETUNREACH:
    case EADDRNOTAVAIL:
      return {PortProblem::kUnreachable, name, "no way leads there"};
    default:
      return port_error_from_errno(error, name);
  }
}

}  // namespace

TcpPort::TcpPort(const TcpAddress& address, Duration timeout) : DescriptorPort(to_text(address)) {
  const std::vector<SocketAddress> ways = look_up(address);
  const Clock::time_point end = Clock::now() + timeout;
  int refused = 0;
  int other = 0;
  for (const SocketAddress& way : ways) {
    descriptor_ = connect_to(way, end);
    if (descriptor_ >= 0) break;
    (errno == ECONNREFUSED ? refused : other) = errno;
  }
  // A host that refuses is there, which tells more than that another of its addresses leads nowhere.
  if (descriptor_ < 0) throw connect_error(refused != 0 ? refused : other, address, timeout);
  set_up();
}

TcpPort::TcpPort(int socket, const std::string& name) : DescriptorPort(name) {
  descriptor_ = socket;
  ::fcntl(descriptor_, F_SETFL, ::fcntl(descriptor_, F_GETFL) | O_NONBLOCK);
  set_up();
}

TcpPort::~TcpPort() {
  TcpPort::close();
}

void TcpPort::set_up() {
  set_option(descriptor_, IPPROTO_TCP, TCP_NODELAY, 1);
  set_option(descriptor_, SOL_SOCKET, SO_KEEPALIVE, 1);
  set_option(descriptor_, IPPROTO_TCP, TCP_KEEPIDLE, kSilentSeconds);
  set_option(descriptor_, IPPROTO_TCP, TCP_KEEPINTVL, kSecondsBetweenQuestions);
  set_option(descriptor_, IPPROTO_TCP, TCP_KEEPCNT, kQuestions);
  set_option(descriptor_, IPPROTO_TCP, TCP_USER_TIMEOUT, kUnconfirmedMs);
}

void TcpPort::discard() {
  std::array<char, 4096> bytes;
  while (::recv(descriptor_, bytes.data(), bytes.size(), MSG_DONTWAIT) > 0) {
  }
}

void TcpPort::close() {
  if (descriptor_ < 0) return;
  // A socket closed over unread bytes resets the connection, and what was just written could be lost with it.
  ::shutdown(descriptor_, SHUT_WR);
  let_leave();
  discard();
  ::close(descriptor_);
  descriptor_ = -1;
}

ssize_t TcpPort::send(std::string_view bytes) {
  // A peer that has gone is an error to report, not a signal that ends the program.
  return ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
}

}  // namespace lamina::transport
