#include "transport/port/serial_port.h"

#include <cerrno>
#include <string>

#include <fcntl.h>
#include <libserialport.h>
#include <sys/ioctl.h>

namespace lamina::transport {

namespace {

/// The error of the libserialport call that has just returned `result`.
PortError serial_error(sp_return result, const std::string& path) {
  // SP_ERR_ARG comes from the name look-up: no such entry in sysfs.
  if (result == SP_ERR_ARG) return {PortProblem::kNoSuchDevice, path, "no such serial device"};
  const int code = sp_last_error_code();
  return port_error_from_errno(code != 0 ? code : EIO, path);
}

}  // namespace

SerialPort::SerialPort(const std::string& path, int baud) : DescriptorPort(path) {
  const auto check = [&](sp_return result) {
    if (result == SP_OK) return;
    const PortError error = serial_error(result, path);
    SerialPort::close();
    throw error;
  };
  check(sp_get_port_by_name(path.c_str(), &port_));
  if (const sp_return opened = sp_open(port_, SP_MODE_READ_WRITE); opened != SP_OK) {
    const PortError error = serial_error(opened, path);
    sp_free_port(port_);
    port_ = nullptr;
    throw error;
  }
  check(sp_get_port_handle(port_, &descriptor_));
  try {
    claim();
  } catch (...) {
    SerialPort::close();
    throw;
  }
  // The lock above holds among programs that ask for it; this keeps the others out.
  ::ioctl(descriptor_, TIOCEXCL);
  if (sp_set_baudrate(port_, baud) != SP_OK) {
    SerialPort::close();
    throw PortError(PortProblem::kUnsupportedBaud, path, "cannot run at " + std::to_string(baud) + " baud");
  }
  check(sp_set_bits(port_, 8));
  check(sp_set_parity(port_, SP_PARITY_NONE));
  check(sp_set_stopbits(port_, 1));
  check(sp_set_flowcontrol(port_, SP_FLOWCONTROL_NONE));
  const int flags = ::fcntl(descriptor_, F_GETFL);
  if (::fcntl(descriptor_, F_SETFL, flags | O_NONBLOCK) < 0) check(SP_ERR_FAIL);
  discard();
}

SerialPort::~SerialPort() {
  SerialPort::close();
}

void SerialPort::close() {
  if (port_ == nullptr) return;
  sp_close(port_);
  sp_free_port(port_);
  port_ = nullptr;
  descriptor_ = -1;
}

}  // namespace lamina::transport
