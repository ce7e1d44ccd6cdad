#include "transport/port/serial_port.h"

#include <cerrno>
#include <string>
#include <thread>

#include <fcntl.h>
#include <libserialport.h>
#include <linux/serial.h>
#include <sys/ioctl.h>
#include <termios.h>

#include "transport/port/raw_terminal.h"

namespace lamina::transport {

namespace {

/// How long DTR is down for a restart: boards couple it to their reset pin through a capacitor, and need some
/// milliseconds; some adapters pass it on late.
constexpr std::chrono::milliseconds kRestartPulse{250};

/// Whether the system lets DTR fall when the last descriptor is closed, be it by the death of the program.
bool set_dtr_falls_on_close(int descriptor, bool falls) {
  termios settings{};
  if (::tcgetattr(descriptor, &settings) != 0) return false;
  if (falls) {
    settings.c_cflag |= HUPCL;
  } else {
    settings.c_cflag &= ~static_cast<tcflag_t>(HUPCL);
  }
  return ::tcsetattr(descriptor, TCSANOW, &settings) == 0;
}

/// Adapters by FTDI hold bytes back for 16 ms otherwise. Drivers that cannot do it refuse, which is no harm.
void ask_for_low_latency(int descriptor) {
  serial_struct serial{};
  if (::ioctl(descriptor, TIOCGSERIAL, &serial) != 0) return;
  serial.flags |= ASYNC_LOW_LATENCY;
  ::ioctl(descriptor, TIOCSSERIAL, &serial);
}

}  // namespace

SerialPort::SerialPort(const std::string& path, const PortOptions& options) : DescriptorPort(path) {
  check(sp_get_port_by_name(path.c_str(), &port_));
  try {
    check(sp_open(port_, SP_MODE_READ_WRITE));
  } catch (...) {
    free_port();
    throw;
  }
  try {
    configure(options);
  } catch (...) {
    sp_close(port_);
    free_port();
    throw;
  }
}

SerialPort::~SerialPort() {
  SerialPort::close();
}

void SerialPort::configure(const PortOptions& options) {
  check(sp_get_port_handle(port_, &descriptor_));
  claim();
  // The lock above holds among programs that ask for it; this keeps the others out.
  ::ioctl(descriptor_, TIOCEXCL);
  check(sp_set_bits(port_, 8));
  check(sp_set_parity(port_, SP_PARITY_NONE));
  check(sp_set_stopbits(port_, 1));
  check(sp_set_flowcontrol(port_, SP_FLOWCONTROL_NONE));
  set_baud(options.baud);
  // libserialport sets reading up so that no byte looks like a hang-up.
  const int flags = ::fcntl(descriptor_, F_GETFL);
  if (!make_raw(descriptor_) || !set_dtr_falls_on_close(descriptor_, false) ||
      ::fcntl(descriptor_, F_SETFL, flags | O_NONBLOCK) < 0) {
    throw port_error_from_errno(errno, path_);
  }
  dtr_falls_on_close_ = options.restart != BoardRestart::kAvoid;
  ask_for_low_latency(descriptor_);
  if (options.restart == BoardRestart::kForce) {
    check(sp_set_dtr(port_, SP_DTR_OFF));
    check(sp_set_rts(port_, SP_RTS_OFF));
    std::this_thread::sleep_for(kRestartPulse);
    check(sp_set_dtr(port_, SP_DTR_ON));
    check(sp_set_rts(port_, SP_RTS_ON));
  }
  discard();
}

void SerialPort::close() {
  if (port_ == nullptr) return;
  let_leave();
  // What has not left by now never will; the system would wait for it for half a minute.
  ::tcflush(descriptor_, TCOFLUSH);
  if (dtr_falls_on_close_) set_dtr_falls_on_close(descriptor_, true);
  ::ioctl(descriptor_, TIOCNXCL);
  sp_close(port_);
  free_port();
}

void SerialPort::set_baud(int baud) {
  if (sp_set_baudrate(port_, baud) == SP_OK) return;
  const int error = sp_last_error_code();
  if (error == EIO || error == ENXIO || error == ENODEV) throw port_error_from_errno(error, path_);
  throw PortError(PortProblem::kUnsupportedBaud, path_, "cannot run at " + std::to_string(baud) + " baud");
}

void SerialPort::check(int result) const {
  if (result == SP_OK) return;
  // This one comes from the name look-up: no such entry in sysfs.
  if (result == SP_ERR_ARG) throw PortError(PortProblem::kNoSuchDevice, path_, "no such serial device");
  const int error = sp_last_error_code();
  throw port_error_from_errno(error != 0 ? error : EIO, path_);
}

void SerialPort::free_port() {
  sp_free_port(port_);
  port_ = nullptr;
  descriptor_ = -1;
}

}  // namespace lamina::transport
