#pragma once

namespace lamina::transport {

/// Sets the terminal behind `descriptor` to any speed in bits per second, also those that termios has no name
/// for (250000). False if the device refuses (errno says why).
bool set_terminal_speed(int descriptor, int baud);

/// The speed that is set, bits per second; 0 if `descriptor` is no terminal. Of a pseudo-terminal both ends
/// tell the same: what its host has set.
int terminal_speed(int descriptor);

}  // namespace lamina::transport
