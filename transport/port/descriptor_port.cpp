#include "transport/port/descriptor_port.h"

#include <algorithm>
#include <cerrno>
#include <thread>

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

namespace lamina::transport {

namespace {

constexpr std::chrono::seconds kTimeToLeave{1};

bool nothing_now(int error) {
  return error == EAGAIN || error == EWOULDBLOCK;
}

}  // namespace

std::size_t DescriptorPort::read(std::span<char> into) {
  if (into.empty()) return 0;
  ssize_t count = 0;
  do {
    count = ::read(descriptor_, into.data(), into.size());
  } while (count < 0 && errno == EINTR);
  if (count > 0) return static_cast<std::size_t>(count);
  if (count < 0 && nothing_now(errno)) return 0;
  if (count < 0) throw failure(errno);
  // Where there are only no bytes the system says EAGAIN; end of file means that the other side hung up.
  failed_ = true;
  throw PortError(PortProblem::kUnplugged, path_, "the device has hung up");
}

std::size_t DescriptorPort::write(std::string_view bytes) {
  if (bytes.empty()) return 0;
  ssize_t count = 0;
  do {
    count = send(bytes);
  } while (count < 0 && errno == EINTR);
  if (count >= 0) return static_cast<std::size_t>(count);
  if (nothing_now(errno)) return 0;
  throw failure(errno);
}

void DescriptorPort::wait(Duration at_most, bool until_writable) {
  const auto at_most_ms = std::chrono::ceil<std::chrono::milliseconds>(at_most).count();
  pollfd watched{descriptor_, static_cast<short>(until_writable ? POLLIN | POLLOUT : POLLIN), 0};
  const int ready = ::poll(&watched, 1, static_cast<int>(std::clamp<std::int64_t>(at_most_ms, 0, 60'000)));
  if (ready < 0 && errno != EINTR) throw failure(errno);
}

void DescriptorPort::discard() {
  ::tcflush(descriptor_, TCIOFLUSH);
}

void DescriptorPort::claim() const {
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) throw port_error_from_errno(errno, path_);
}

void DescriptorPort::let_leave() const {
  const auto end = std::chrono::steady_clock::now() + kTimeToLeave;
  int waiting = 0;
  // On a terminal and on a socket alike.
  while (!failed_ && ::ioctl(descriptor_, TIOCOUTQ, &waiting) == 0 && waiting > 0 &&
         std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

ssize_t DescriptorPort::send(std::string_view bytes) {
  return ::write(descriptor_, bytes.data(), bytes.size());
}

PortError DescriptorPort::failure(int error) {
  failed_ = true;
  return port_error_from_errno(error, path_);
}

}  // namespace lamina::transport
