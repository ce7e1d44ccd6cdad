#include "tests/support/pretend_serial.h"

#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <set>
#include <string>

#include <asm/termbits.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <linux/serial.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace {

struct Device {
  std::string path;       // /dev/NAME
  std::string sys_entry;  // /sys/class/tty/NAME
  std::string pty;
  std::set<int> descriptors;
  int modem_lines = 0;
  int restarts = 0;
  int serial_flags = 0;
  int open_error = 0;
  int refused_baud = 0;
  bool has_serial_settings = true;
};

Device* device = nullptr;

template <typename Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

bool is_device(const char* path) {
  return device != nullptr && path != nullptr && device->path == path;
}

bool is_entry(const char* path) {
  return device != nullptr && path != nullptr && device->sys_entry == path;
}

bool is_open(int descriptor) {
  return device != nullptr && device->descriptors.count(descriptor) > 0;
}

void set_modem_lines(int lines) {
  if ((lines & TIOCM_DTR) != 0 && (device->modem_lines & TIOCM_DTR) == 0) ++device->restarts;
  device->modem_lines = lines;
}

int open_device(int flags) {
  if (device->open_error != 0) {
    errno = device->open_error;
    return -1;
  }
  const int descriptor = next<int(const char*, int, ...)>("open")(device->pty.c_str(), flags);
  if (descriptor < 0) return descriptor;
  device->descriptors.insert(descriptor);
  // As the kernel does in every first open.
  set_modem_lines(device->modem_lines | TIOCM_DTR | TIOCM_RTS);
  return descriptor;
}

void before_close(int descriptor) {
  termios2 settings{};
  const bool told = next<int(int, unsigned long, ...)>("ioctl")(descriptor, TCGETS2, &settings) == 0;
  device->descriptors.erase(descriptor);
  if (device->descriptors.empty() && (!told || (settings.c_cflag & HUPCL) != 0)) set_modem_lines(0);
}

int fail(int error) {
  errno = error;
  return -1;
}

/// The calls that a pseudo-terminal does not know.
int device_ioctl(int descriptor, unsigned long request, void* argument) {
  switch (request) {
    case TIOCMGET:
      *static_cast<int*>(argument) = device->modem_lines | TIOCM_CTS | TIOCM_DSR | TIOCM_CAR;
      return 0;
    case TIOCMSET:
      set_modem_lines(*static_cast<int*>(argument) & (TIOCM_DTR | TIOCM_RTS));
      return 0;
    case TIOCMBIS:
      set_modem_lines(device->modem_lines | *static_cast<int*>(argument));
      return 0;
    case TIOCMBIC:
      set_modem_lines(device->modem_lines & ~*static_cast<int*>(argument));
      return 0;
    case TIOCGSERIAL:
      if (!device->has_serial_settings) return fail(ENOTTY);
      static_cast<serial_struct*>(argument)->flags = device->serial_flags;
      return 0;
    case TIOCSSERIAL:
      if (!device->has_serial_settings) return fail(ENOTTY);
      device->serial_flags = static_cast<serial_struct*>(argument)->flags;
      return 0;
    case TCSETS2:
      if (device->refused_baud != 0 &&
          static_cast<int>(static_cast<termios2*>(argument)->c_ospeed) == device->refused_baud) {
        return fail(EINVAL);
      }
      break;
    default:
      break;
  }
  return next<int(int, unsigned long, ...)>("ioctl")(descriptor, request, argument);
}

}  // namespace

// NOLINTBEGIN(readability-identifier-naming, cert-dcl51-cpp): libc's names
extern "C" {

int open(const char* path, int flags, ...) {
  std::va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? static_cast<mode_t>(va_arg(arguments, int)) : 0;
  va_end(arguments);
  if (is_device(path)) return open_device(flags);
  return next<int(const char*, int, ...)>("open")(path, flags, mode);
}

int __open_2(const char* path, int flags) {
  return open(path, flags);
}

int close(int descriptor) {
  if (is_open(descriptor)) before_close(descriptor);
  return next<int(int)>("close")(descriptor);
}

int ioctl(int descriptor, unsigned long request, ...) noexcept {
  std::va_list arguments;
  va_start(arguments, request);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  if (is_open(descriptor)) return device_ioctl(descriptor, request, argument);
  return next<int(int, unsigned long, ...)>("ioctl")(descriptor, request, argument);
}

ssize_t readlink(const char* path, char* target, size_t size) noexcept {
  if (!is_entry(path)) return next<ssize_t(const char*, char*, size_t)>("readlink")(path, target, size);
  const std::string leads_to = "../../devices/pretended/tty/" + device->sys_entry.substr(15);
  return static_cast<ssize_t>(leads_to.copy(target, size));
}

char* realpath(const char* path, char* resolved) noexcept {
  if (!is_device(path)) return next<char*(const char*, char*)>("realpath")(path, resolved);
  return resolved == nullptr ? ::strdup(path) : std::strcpy(resolved, path);
}

int stat(const char* path, struct stat* status) noexcept {
  if (is_device(path)) path = device->pty.c_str();
  if (is_entry(path)) path = "/sys/class/tty";
  return next<int(const char*, struct stat*)>("stat")(path, status);
}

/// How libraries built before glibc 2.33 ask; libserialport wants to know whether the entry is a link.
int __lxstat(int version, const char* path, struct stat* status) noexcept {
  if (!is_entry(path)) return next<int(int, const char*, struct stat*)>("__lxstat")(version, path, status);
  *status = {};
  status->st_mode = S_IFLNK | 0777;
  return 0;
}

}  // extern "C"
// NOLINTEND(readability-identifier-naming, cert-dcl51-cpp)

namespace lamina::tests {

PretendSerial::PretendSerial(const std::string& name, const std::string& pty) {
  device = new Device;
  device->path = "/dev/" + name;
  device->sys_entry = "/sys/class/tty/" + name;
  device->pty = pty;
}

PretendSerial::~PretendSerial() {
  delete device;
  device = nullptr;
}

std::string PretendSerial::path() const {
  return device->path;
}

bool PretendSerial::dtr() const {
  return (device->modem_lines & TIOCM_DTR) != 0;
}

bool PretendSerial::rts() const {
  return (device->modem_lines & TIOCM_RTS) != 0;
}

int PretendSerial::restarts() const {
  return device->restarts;
}

bool PretendSerial::low_latency() const {
  return (device->serial_flags & ASYNC_LOW_LATENCY) != 0;
}

int PretendSerial::open_descriptors() const {
  return static_cast<int>(device->descriptors.size());
}

void PretendSerial::refuse_open(int error) {
  device->open_error = error;
}

void PretendSerial::refuse_speed(int baud) {
  device->refused_baud = baud;
}

void PretendSerial::refuse_serial_settings() {
  device->has_serial_settings = false;
}

void PretendSerial::kill_host() {
  while (!device->descriptors.empty()) ::close(*device->descriptors.begin());
}

}  // namespace lamina::tests
