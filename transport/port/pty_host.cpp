#include "transport/port/pty_host.h"

#include <array>
#include <cerrno>
#include <cstdlib>

#include <fcntl.h>
#include <unistd.h>

#include "transport/port/raw_terminal.h"
#include "transport/port/terminal_speed.h"

namespace lamina::transport {

PtyHost::PtyHost() : DescriptorPort("/dev/ptmx") {
  const auto check = [this](bool succeeded) {
    if (succeeded) return;
    const int error = errno;
    PtyHost::close();
    throw port_error_from_errno(error, path_);
  };
  descriptor_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  check(descriptor_ >= 0);
  check(::grantpt(descriptor_) == 0 && ::unlockpt(descriptor_) == 0);
  std::array<char, 128> host_path{};
  check(::ptsname_r(descriptor_, host_path.data(), host_path.size()) == 0);
  path_ = host_path.data();
  host_side_ = ::open(path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  check(host_side_ >= 0 && make_raw(host_side_));
  const int flags = ::fcntl(descriptor_, F_GETFL);
  check(::fcntl(descriptor_, F_SETFL, flags | O_NONBLOCK) == 0);
}

PtyHost::~PtyHost() {
  PtyHost::close();
}

int PtyHost::host_baud() const {
  return terminal_speed(descriptor_);
}

void PtyHost::close() {
  if (host_side_ >= 0) ::close(host_side_);
  if (descriptor_ >= 0) ::close(descriptor_);
  host_side_ = -1;
  descriptor_ = -1;
}

}  // namespace lamina::transport
