#include "transport/port/pty_port.h"

#include <cerrno>

#include <fcntl.h>
#include <unistd.h>

#include "transport/port/raw_terminal.h"
#include "transport/port/terminal_speed.h"

namespace lamina::transport {

PtyPort::PtyPort(const std::string& path, int baud) : DescriptorPort(path) {
  descriptor_ = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) throw port_error_from_errno(errno, path);
  try {
    claim();
    if (!make_raw(descriptor_)) throw port_error_from_errno(errno, path);
    set_baud(baud);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
  discard();
}

PtyPort::~PtyPort() {
  PtyPort::close();
}

void PtyPort::close() {
  if (descriptor_ < 0) return;
  let_leave();
  ::close(descriptor_);
  descriptor_ = -1;
}

void PtyPort::set_baud(int baud) {
  if (!set_terminal_speed(descriptor_, baud)) throw port_error_from_errno(errno, path_);
}

}  // namespace lamina::transport
