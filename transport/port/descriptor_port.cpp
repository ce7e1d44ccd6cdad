#include "transport/port/descriptor_port.h"

#include <algorithm>
#include <cerrno>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <termios.h>
#include <unistd.h>

namespace lamina::transport {

namespace {

bool nothing_now(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

}  // namespace

std::size_t DescriptorPort::read(std::span<char> into) {
  const ssize_t count = ::read(descriptor_, into.data(), into.size());
  if (count > 0) return static_cast<std::size_t>(count);
  if (count < 0 && nothing_now(errno)) return 0;
  if (count < 0) throw port_error_from_errno(errno, path_);
  // A terminal without bytes says EAGAIN; end of file means that the other side hung up.
  throw PortError(PortProblem::kUnplugged, path_, "the device has hung up");
}

std::size_t DescriptorPort::write(std::string_view bytes) {
  if (bytes.empty()) return 0;
  const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
  if (count >= 0) return static_cast<std::size_t>(count);
  if (nothing_now(errno)) return 0;
  throw port_error_from_errno(errno, path_);
}

void DescriptorPort::wait(Duration at_most, bool until_writable) {
  const auto at_most_ms = std::chrono::ceil<std::chrono::milliseconds>(at_most).count();
  pollfd watched{descriptor_, static_cast<short>(until_writable ? POLLIN | POLLOUT : POLLIN), 0};
  const int ready = ::poll(&watched, 1, static_cast<int>(std::clamp<std::int64_t>(at_most_ms, 0, 60'000)));
  if (ready < 0 && errno != EINTR) throw port_error_from_errno(errno, path_);
}

void DescriptorPort::discard() {
  ::tcflush(descriptor_, TCIOFLUSH);
}

void DescriptorPort::claim() const {
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) throw port_error_from_errno(errno, path_);
}

}  // namespace lamina::transport
