#pragma once

namespace lamina::transport {

/// Makes the terminal behind `descriptor` pass every byte as it is: no echo, no line editing, no signals, no
/// flow control; reading without a byte there says EAGAIN, not end of file. Leaves the speed alone. False if
/// it is no terminal (errno says why).
bool make_raw(int descriptor);

}  // namespace lamina::transport
