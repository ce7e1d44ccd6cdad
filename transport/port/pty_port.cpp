#include "transport/port/pty_port.h"

#include <cerrno>

#include <fcntl.h>
#include <unistd.h>

#include "transport/port/raw_terminal.h"

namespace lamina::transport {

PtyPort::PtyPort(const std::string& path) : DescriptorPort(path) {
  descriptor_ = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) throw port_error_from_errno(errno, path);
  try {
    claim();
    if (!make_raw(descriptor_)) throw port_error_from_errno(errno, path);
  } catch (...) {
    PtyPort::close();
    throw;
  }
  discard();
}

PtyPort::~PtyPort() {
  PtyPort::close();
}

void PtyPort::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

}  // namespace lamina::transport
