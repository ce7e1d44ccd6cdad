#include "transport/port/terminal_speed.h"

// The kernel's own termios2, which carries a speed as a number; it cannot be seen together with <termios.h>.
#include <asm/termbits.h>
#include <sys/ioctl.h>

namespace lamina::transport {

bool set_terminal_speed(int descriptor, int baud) {
  termios2 settings{};
  if (::ioctl(descriptor, TCGETS2, &settings) != 0) return false;
  settings.c_cflag &= ~static_cast<tcflag_t>(CBAUD | CIBAUD);
  settings.c_cflag |= BOTHER | (BOTHER << IBSHIFT);
  settings.c_ispeed = settings.c_ospeed = static_cast<speed_t>(baud);
  return ::ioctl(descriptor, TCSETS2, &settings) == 0;
}

int terminal_speed(int descriptor) {
  termios2 settings{};
  return ::ioctl(descriptor, TCGETS2, &settings) == 0 ? static_cast<int>(settings.c_ospeed) : 0;
}

}  // namespace lamina::transport
