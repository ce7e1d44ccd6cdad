#include "transport/port/raw_terminal.h"

#include <termios.h>

namespace lamina::transport {

bool make_raw(int descriptor) {
  termios settings{};
  if (::tcgetattr(descriptor, &settings) != 0) return false;
  ::cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_iflag &= ~static_cast<tcflag_t>(IXON | IXOFF | IXANY);
  return ::tcsetattr(descriptor, TCSANOW, &settings) == 0;
}

}  // namespace lamina::transport
